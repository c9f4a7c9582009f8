#include "engine/base/counted.hpp"

#include <gtest/gtest.h>

#include <cstdint>

namespace spheroscope {
namespace {

TEST(Counted, HasTheSingularForOneThingOnly) {
    EXPECT_EQ(counted(1, "seed"), "1 seed");
    EXPECT_EQ(counted(0, "seed"), "0 seeds");
    EXPECT_EQ(counted(2, "seed"), "2 seeds");
    EXPECT_EQ(counted(std::size_t{1}, "linear iteration"), "1 linear iteration");
    EXPECT_EQ(counted(std::int64_t{5000000000}, "step"), "5000000000 steps");
    EXPECT_EQ(counted(-1, "cell"), "-1 cells");
}

}  // namespace
}  // namespace spheroscope
