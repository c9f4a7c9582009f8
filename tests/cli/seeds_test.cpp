#include "engine/base/error.hpp"
#include "engine/cli/seeds.hpp"

#include <gtest/gtest.h>

namespace spheroscope::cli {
namespace {

using Seeds = std::vector<std::uint64_t>;

TEST(Seeds, AreARangeAListOrBoth) {
    EXPECT_EQ(parse_seeds("1..5"), (Seeds{1, 2, 3, 4, 5}));
    EXPECT_EQ(parse_seeds("7"), Seeds{7});
    EXPECT_EQ(parse_seeds("4,2"), (Seeds{4, 2}));
    EXPECT_EQ(parse_seeds("1..2,10"), (Seeds{1, 2, 10}));
    EXPECT_EQ(parse_seeds("999999999999999999..999999999999999999").size(), 1U);
}

TEST(Seeds, OfAnyOtherTextAreRefusedWithWhatWasGot) {
    for (const char* text :
         {"", "a", "1...5", "1..", "..3", "-1", "1,,2", "1 .. 5", "5..1", "1,1", "1..3,2",
          "1..1001", "0..18446744073709551615", "1000000000000000000", "7..99999999999999999999"})
        try {
            static_cast<void>(parse_seeds(text));
            ADD_FAILURE() << text << " was read";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::usage);
            EXPECT_NE(std::string(error.what()).find("'" + std::string(text) + "'"),
                      std::string::npos)
                << error.what();
        }
}

TEST(Seeds, HaveTheNumbersThatOneSeedMayBe) {
    for (const char* text : {"0", "1", "007", "999999999999999999"}) {
        EXPECT_EQ(problem_of_seed(text), "");
        EXPECT_EQ(parse_seeds(text).size(), 1U);
    }
    try {
        static_cast<void>(parse_seeds("3,1000000000000000000"));
        FAIL();
    } catch (const Error& error) {
        const std::string problem = problem_of_seed("1000000000000000000");
        EXPECT_NE(problem.find("at most 18 digits"), std::string::npos) << problem;
        EXPECT_NE(std::string(error.what()).find(problem), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace spheroscope::cli
