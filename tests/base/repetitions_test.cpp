#include "engine/base/repetitions.hpp"

#include <gtest/gtest.h>

#include <atomic>

namespace spheroscope {
namespace {

int repetitions_made(const Repetitions& repetitions) {
    int n = 0;
    for (Repetitions::Count count(repetitions); count.goes_on();) ++n;
    return n;
}

TEST(Repetitions, AreAsManyAsAskedFor) {
    EXPECT_EQ(repetitions_made({.most = 7, .longest_s = 1e3}), 7);
}

TEST(Repetitions, OneIsMadeHoweverLittleTimeThereIs) {
    EXPECT_EQ(repetitions_made({.most = 7, .longest_s = 0.0}), 1);
}

TEST(Repetitions, EndWhenTheyAreStopped) {
    std::atomic<bool> stop{false};
    const Repetitions repetitions{.most = 7, .longest_s = 1e3, .stop = &stop};
    Repetitions::Count count(repetitions);
    ASSERT_TRUE(count.goes_on());
    ASSERT_TRUE(count.goes_on());
    stop = true;
    EXPECT_FALSE(count.goes_on());
    EXPECT_EQ(count.n_begun(), 2);
}

}  // namespace
}  // namespace spheroscope
