#include "engine/base/nearest_word.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>

namespace spheroscope {
namespace {

TEST(CountSlips, EveryKindOfSlipCountsOnce) {
    EXPECT_EQ(count_slips("render", "render"), 0);
    EXPECT_EQ(count_slips("rendr", "render"), 1);    // a letter too few
    EXPECT_EQ(count_slips("rennder", "render"), 1);  // one too many
    EXPECT_EQ(count_slips("rendar", "render"), 1);   // a wrong one
    EXPECT_EQ(count_slips("redner", "render"), 1);   // two swapped
}

TEST(CountSlips, AgainstNothingEveryLetterIsASlip) {
    EXPECT_EQ(count_slips("", "movie"), 5);
    EXPECT_EQ(count_slips("movie", ""), 5);
}

TEST(NearestWord, ASlipFindsTheWordThatWasMeant) {
    const std::array<std::string, 3> verbs{"run", "movie", "render"};
    EXPECT_EQ(nearest_word("moive", verbs), "movie");
    EXPECT_EQ(nearest_word("rn", verbs), "run");
}

TEST(NearestWord, OfTwoNearWordsTheOneWithFewerSlipsWins) {
    const std::array<std::string, 2> keys{"omega", "gamma"};
    EXPECT_EQ(nearest_word("gamna", keys), "gamma");
    EXPECT_EQ(nearest_word("omgea", keys), "omega");
}

TEST(NearestWord, AWordThatIsNearNothingGetsNoProposal) {
    const std::array<std::string, 3> verbs{"run", "movie", "render"};
    EXPECT_EQ(nearest_word("frobnicate", verbs), "");
    EXPECT_EQ(nearest_word("x", verbs), "");
}

}  // namespace
}  // namespace spheroscope
