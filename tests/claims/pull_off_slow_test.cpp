// The force that parts two cells lies between what theory says of soft liquid and of elastic
// spheres (JKR 3/4 pi R W, DMT pi R W), within what a mesh and a finite range of adhesion can
// change.

#include "engine/reports/pull_off_force.hpp"

#include <gtest/gtest.h>

namespace spheroscope::test {
namespace {

TEST(PullOff, OfTwoCellsIsNearPiRWAndGrowsWithTheStiffnessOfTheCortex) {
    const std::vector<reports::PullOff> rows = reports::measure_pull_off(
        std::string(SPHEROSCOPE_SOURCE_DIR) + "/scenes/claims/pull_off.toml", {},
        {.rate_nN_per_s = 0.1, .threads = 1});
    ASSERT_EQ(rows.size(), 5U);
    double before = 0.0;
    for (const reports::PullOff& row : rows) {
        EXPECT_EQ(row.problem, "") << row.variant;
        EXPECT_GT(row.over_pi_R_W, 0.5) << row.variant;
        EXPECT_LT(row.over_pi_R_W, 1.1) << row.variant;
        EXPECT_GT(row.over_pi_R_W, before) << row.variant;
        before = row.over_pi_R_W;
    }
}

}  // namespace
}  // namespace spheroscope::test
