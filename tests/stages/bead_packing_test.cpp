#include "engine/base/error.hpp"
#include "engine/stages/bead_packing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace spheroscope {
namespace {

void finish(BeadPacking& packing) {
    while (!packing.is_finished()) packing.advance(1000);
}

/// 60 beads in a few thousand steps: a tenth of a second.
BeadPackingParameters quick() {
    BeadPackingParameters parameters;
    parameters.packing_fraction = 0.56;
    parameters.steps = 4000;
    return parameters;
}

BeadPacking quick_packing(std::uint64_t seed = 1) {
    return {draw_radii({}, 60, seed), quick(), seed};
}

bool same_bits(const BeadPacking& a, const BeadPacking& b) {
    return std::equal(a.centre_um().begin(), a.centre_um().end(), b.centre_um().begin(),
                      b.centre_um().end());
}

TEST(CellRadii, UncutFollowTheGammaDistribution) {
    constexpr int n = 20000;
    const RadiusDistribution uncut{37.75, 0.24, 1e-3, 1e3};
    const std::vector<double> r_um = draw_radii(uncut, n, 11);
    double mean = 0.0;
    for (const double r : r_um) mean += r / n;
    double variance = 0.0, third = 0.0;
    for (const double r : r_um) {
        variance += (r - mean) * (r - mean) / n;
        third += std::pow(r - mean, 3) / n;
    }
    const double deviation = std::sqrt(variance);
    // Four standard errors each: s / sqrt(n), s / sqrt(2 n), sqrt(6 / n).
    EXPECT_NEAR(mean, 9.06, 0.042);
    EXPECT_NEAR(deviation, 1.475, 0.030);
    EXPECT_NEAR(third / std::pow(deviation, 3), 2.0 / std::sqrt(37.75), 0.070);  // a normal has 0
}

TEST(CellRadii, LieInTheRangeAndReachBothEndsOfIt) {
    const RadiusDistribution narrow{37.75, 0.24, 8.5, 9.5};
    const std::vector<double> r_um = draw_radii(narrow, 2000, 2);
    const auto [min, max] = std::minmax_element(r_um.begin(), r_um.end());
    EXPECT_GE(*min, 8.5);
    EXPECT_LE(*max, 9.5);
    EXPECT_LT(*min, 8.51);
    EXPECT_GT(*max, 9.49);
    // Drawn again, not moved to the edge.
    EXPECT_EQ(std::count(r_um.begin(), r_um.end(), *min), 1);
    EXPECT_EQ(std::count(r_um.begin(), r_um.end(), *max), 1);
}

TEST(CellRadii, MoreCellsKeepTheFirstOnesAndAnotherSeedKeepsNone) {
    const std::vector<double> few = draw_radii({}, 20, 7), many = draw_radii({}, 50, 7);
    const std::vector<double> other = draw_radii({}, 20, 8);
    for (std::size_t i = 0; i < few.size(); ++i) {
        EXPECT_EQ(few[i], many[i]);
        EXPECT_NE(few[i], other[i]);
    }
}

TEST(CellRadii, ARangeThatHardlyAnyRadiusMeetsIsRefused) {
    EXPECT_THROW(static_cast<void>(draw_radii({37.75, 0.24, 30.0, 40.0}, 1, 1)), Error);
    EXPECT_THROW(static_cast<void>(draw_radii({37.75, 0.24, 13.0, 5.0}, 1, 1)), Error);
    EXPECT_THROW(static_cast<void>(draw_radii({0.5, 0.24, 5.0, 13.0}, 1, 1)), Error);
    EXPECT_THROW(static_cast<void>(draw_radii({37.75, -0.24, 5.0, 13.0}, 1, 1)), Error);
    EXPECT_THROW(static_cast<void>(draw_radii({}, 0, 1)), Error);
}

class Packed : public testing::Test {
  protected:
    Packed() : packing(quick_packing()) { finish(packing); }
    BeadPacking packing;
};

TEST_F(Packed, BeadsOverlapByLessThanTwoPercent) {
    const PackingOutcome outcome = packing.outcome();
    EXPECT_EQ(outcome.verdict, PackingVerdict::packed) << outcome.reason;
    EXPECT_TRUE(outcome.reason.empty());
    EXPECT_LT(outcome.mean_overlap, 0.02);
    EXPECT_GT(outcome.mean_overlap, 0.0);
    EXPECT_GE(outcome.largest_overlap, outcome.mean_overlap);
    EXPECT_GT(outcome.n_contacts, 2 * 60);  // Z > 4: a packing, not a gas
}

TEST_F(Packed, SphereHoldsTheAskedFractionOfBeads) {
    double cubes_um3 = 0.0;
    for (const double r : packing.radius_um()) cubes_um3 += r * r * r;
    EXPECT_NEAR(cubes_um3 / std::pow(packing.box_radius_um(), 3), 0.56, 1e-12);
}

TEST_F(Packed, EveryBeadIsInForceBalance) {
    // In um and from all pairs, without the packing's own force code.
    const auto x = packing.centre_um();
    const auto r = packing.radius_um();
    double mean_radius_um = 0.0;
    for (const double radius : r) mean_radius_um += radius / 60.0;
    const double box_um = packing.box_radius_um();
    const double centring = 0.01 * std::pow(mean_radius_um / box_um, 2);
    for (std::size_t i = 0; i < x.size(); ++i) {
        Vec3 force = -centring * x[i];
        for (std::size_t j = 0; j < x.size(); ++j) {
            const Vec3 d = x[i] - x[j];
            const double overlap = r[i] + r[j] - d.norm();
            if (i != j && overlap > 0.0) force += overlap * d.normalized();
        }
        const double outside = x[i].norm() + r[i] - box_um;
        if (outside > 0.0) force -= outside * x[i].normalized();
        EXPECT_LT(force.norm(), 1.0001e-6 * mean_radius_um) << i;
    }
}

TEST_F(Packed, NoBeadStandsOutOfTheSphereByMoreThanOthersPushIt) {
    const auto x = packing.centre_um();
    const auto r = packing.radius_um();
    int n_at_wall = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        double pushed_um = 0.0;
        for (std::size_t j = 0; j < x.size(); ++j) {
            if (i != j) pushed_um += std::max(0.0, r[i] + r[j] - (x[i] - x[j]).norm());
        }
        const double outside_um = x[i].norm() + r[i] - packing.box_radius_um();
        EXPECT_LE(outside_um, pushed_um + 1e-4) << i;
        EXPECT_LT(outside_um, 0.1 * r[i]) << i;
        if (outside_um > 0.0) ++n_at_wall;
    }
    EXPECT_GT(n_at_wall, 10);
}

TEST_F(Packed, FinishedBeadsStayWhereTheyAre) {
    const BeadPacking before = packing;
    packing.advance(100);
    EXPECT_TRUE(same_bits(before, packing));
    EXPECT_EQ(packing.progress(), 1.0);
}

TEST_F(Packed, SameSeedGivesTheSameBitsAndAnotherSeedDoesNot) {
    BeadPacking again = quick_packing(1);
    finish(again);
    EXPECT_TRUE(same_bits(packing, again));
    BeadPacking other(draw_radii({}, 60, 1), quick(), 2);
    finish(other);
    EXPECT_FALSE(same_bits(packing, other));
}

TEST_F(Packed, CuttingTheRunIntoPiecesChangesNoBit) {
    BeadPacking pieces = quick_packing();
    for (int size = 7; !pieces.is_finished(); size = size == 7 ? 13 : 7) pieces.advance(size);
    EXPECT_TRUE(same_bits(packing, pieces));
    BeadPacking whole = quick_packing();
    whole.advance(1000000);
    EXPECT_TRUE(same_bits(packing, whole));
}

TEST_F(Packed, ASavedStateGoesOnWithTheSameBits) {
    // Early, when lists are short-lived; at the last step of annealing; in the descent; at the end.
    for (const int n_steps : {0, 123, 3999, 4000, 4031, 1000000}) {
        BeadPacking first = quick_packing();
        first.advance(n_steps);
        const BeadPackingState saved = first.state();
        BeadPacking second = quick_packing();
        second.restore(saved);
        EXPECT_TRUE(same_bits(first, second)) << n_steps;
        EXPECT_EQ(first.progress(), second.progress());
        finish(second);
        EXPECT_TRUE(same_bits(packing, second)) << n_steps;
        EXPECT_EQ(packing.state().descent_step, second.state().descent_step);
        EXPECT_EQ(packing.outcome().largest_force, second.outcome().largest_force);
    }
    ASSERT_GT(packing.state().descent_step, 31);  // 4031 was in the descent
}

TEST(BeadPackingState, OfAnotherNumberOfBeadsIsRefused) {
    BeadPacking packing = quick_packing();
    BeadPackingState state = packing.state();
    state.x.pop_back();
    EXPECT_THROW(packing.restore(state), Error);
    BeadPackingState no_velocities = packing.state();
    no_velocities.phase = PackingPhase::descent;
    EXPECT_THROW(packing.restore(no_velocities), Error);
}

TEST(BeadPackingOutcome, TooDenseIsSaidAndNotAccepted) {
    BeadPackingParameters parameters = quick();
    parameters.packing_fraction = 0.80;
    BeadPacking packing(draw_radii({}, 60, 1), parameters, 1);
    EXPECT_EQ(packing.outcome().verdict, PackingVerdict::unfinished);
    finish(packing);
    const PackingOutcome outcome = packing.outcome();
    EXPECT_EQ(outcome.verdict, PackingVerdict::overlapping);
    EXPECT_GT(outcome.mean_overlap, 0.02);
    EXPECT_NE(outcome.reason.find("lower the packing fraction 0.8"), std::string::npos);
}

TEST(BeadPackingOutcome, ADescentCutShortIsSaidAndNotAccepted) {
    BeadPackingParameters parameters = quick();
    parameters.descent_steps_max = 10;
    BeadPacking packing(draw_radii({}, 60, 1), parameters, 1);
    finish(packing);
    const PackingOutcome outcome = packing.outcome();
    EXPECT_EQ(outcome.verdict, PackingVerdict::unbalanced);
    EXPECT_EQ(packing.state().descent_step, 10);
    EXPECT_NE(outcome.reason.find("after 10 descent steps"), std::string::npos);
}

TEST(BeadCentring, BringsLooseBeadsTogetherWithHardlyAnyOverlap) {
    BeadPackingParameters parameters = quick();
    parameters.packing_fraction = 0.30;
    const auto contacts = [&](double centring) {
        parameters.centring = centring;
        BeadPacking packing(draw_radii({}, 60, 1), parameters, 1);
        finish(packing);
        return packing.outcome();
    };
    const PackingOutcome with = contacts(0.01), without = contacts(0.0);
    EXPECT_EQ(without.mean_overlap, 0.0);  // apart from each other
    EXPECT_GT(with.n_contacts, 2 * 60);
    EXPECT_LT(with.mean_overlap, 0.01 / 7.0);  // the estimate for the middle is an upper bound
}

TEST(BeadPackingParameters, OutOfRangeAreRefused) {
    const auto refused = [](auto change) {
        BeadPackingParameters parameters;
        change(parameters);
        EXPECT_THROW(BeadPacking({9.0, 9.0}, parameters, 1), Error);
    };
    refused([](BeadPackingParameters& p) { p.packing_fraction = 1.0; });
    refused([](BeadPackingParameters& p) { p.packing_fraction = std::nan(""); });
    refused([](BeadPackingParameters& p) { p.steps = 0; });
    refused([](BeadPackingParameters& p) { p.dt = 0.5; });
    refused([](BeadPackingParameters& p) { p.first_noise = -0.1; });
    refused([](BeadPackingParameters& p) { p.first_stiffness = 0.0; });
    refused([](BeadPackingParameters& p) { p.force_tolerance = 0.0; });
    EXPECT_THROW(BeadPacking({}, {}, 1), Error);
    EXPECT_THROW(BeadPacking({9.0, -1.0}, {}, 1), Error);
}

TEST(BeadPackingOf, OneBeadEndsInTheMiddle) {
    BeadPacking packing({9.0}, quick(), 1);
    finish(packing);
    EXPECT_EQ(packing.outcome().verdict, PackingVerdict::packed);
    // Its only force, centring, is below tolerance: 1e-6 R / (0.01 R^2 / R_box^2).
    const double box = packing.box_radius_um() / 9.0;
    EXPECT_LT(packing.centre_um()[0].norm(), 1e-4 * 9.0 * box * box);
}

}  // namespace
}  // namespace spheroscope
