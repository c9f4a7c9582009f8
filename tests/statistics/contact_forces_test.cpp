#include "engine/statistics/contact_forces.hpp"
#include "engine/statistics/coordination.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace spheroscope::statistics {
namespace {

const std::vector<PairForce> k_pairs{
    {0, 1, 3.0, 2.0}, {0, 2, -1.0, 0.3}, {1, 2, 2.0, 0.15}, {2, 3, 50.0, 0.05}};

TEST(ContactForces, AreOverTheMeanSizeOfAllTouchingPairs) {
    const ContactForces forces = contact_forces(k_pairs, 0.1, ForceNorm::all);
    EXPECT_DOUBLE_EQ(forces.mean_nN, 2.0);
    EXPECT_EQ(forces.f, (std::vector{1.5, 0.5, 1.0}));
    EXPECT_DOUBLE_EQ(forces.tensile_share, 1.0 / 3.0);
}

TEST(ContactForces, OrOverThatOfThePairsThatPush) {
    const ContactForces forces = contact_forces(k_pairs, 0.1, ForceNorm::compressive);
    EXPECT_DOUBLE_EQ(forces.mean_nN, 2.5);
    EXPECT_EQ(forces.f, (std::vector{1.2, 0.8}));
    EXPECT_DOUBLE_EQ(forces.tensile_share, 1.0 / 3.0);
}

TEST(ContactForces, WithoutPairsAreUndefined) {
    const ContactForces forces = contact_forces({}, 0.1, ForceNorm::all);
    EXPECT_TRUE(forces.f.empty());
    EXPECT_TRUE(std::isnan(forces.mean_nN));
}

TEST(Coordination, FallsAsTheTouchingThresholdRises) {
    EXPECT_DOUBLE_EQ(coordination(k_pairs, 4, 0.01), 2.0);
    EXPECT_DOUBLE_EQ(coordination(k_pairs, 4, 0.1), 1.5);
    EXPECT_DOUBLE_EQ(coordination(k_pairs, 4, 0.2), 1.0);
    EXPECT_DOUBLE_EQ(coordination(k_pairs, 4, 1.0), 0.5);
}

}  // namespace
}  // namespace spheroscope::statistics
