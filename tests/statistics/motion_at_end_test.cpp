#include "engine/statistics/motion_at_end.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace spheroscope::statistics {
namespace {

TEST(MotionAtEnd, IsRemarkedWhateverTheOutcomeIsCalled) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    const std::vector<MotionAtEnd> runs{{1, "rest", 1.2e-3}, {2, "rest", 0.9e-3},
                                        {3, "cap", 0.25},    {4, "", 1e-3},
                                        {5, "rest", 0.0},    {6, "jammed", nan}};
    EXPECT_EQ(remark_on_motion(runs),
              "seed 1 (rest), 3 (cap), 4 (not ended): nodes still move with 0.0012, 0.25, "
              "0.001 um/s (at rest: less than 0.001)");
    EXPECT_EQ(remark_on_motion(std::vector<MotionAtEnd>{runs[1], runs[4], runs[5]}), "");
}

}  // namespace
}  // namespace spheroscope::statistics
