#include "engine/statistics/radial_profile.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace spheroscope::statistics {
namespace {

using Replicates = std::vector<std::vector<ProbeSample>>;

/// A value for each of many evenly spaced distances.
template <class F> std::vector<ProbeSample> samples_of(const F& value) {
    std::vector<ProbeSample> samples;
    for (int i = 0; i < 12000; ++i) {
        const double r = 1e-4 * (i + 0.5);
        samples.push_back({r, value(r)});
    }
    return samples;
}

TEST(RadialProfile, OfAStraightLineHasItsMiddlesAndTheSpreadOfAUniformBin) {
    const Replicates replicates{samples_of([](double r) { return 2.0 * r - 1.0; })};
    const auto profile = pooled_profile(replicates);
    ASSERT_EQ(profile.size(), 24U);
    for (const ProfilePoint& point : profile) {
        EXPECT_NEAR(point.mean, 2.0 * point.r - 1.0, 1e-12);
        EXPECT_NEAR(point.spread, 2.0 * k_bin_width / std::sqrt(12.0), 1e-6);
        EXPECT_EQ(point.n_probes, 500);
        EXPECT_TRUE(std::isnan(point.standard_error)) << "one replicate has none";
    }
    EXPECT_NEAR(zero_crossing(profile), 0.5, 1e-9);
    EXPECT_NEAR(peak(profile), 1.175, 1e-12) << "middle of the last bin";
}

TEST(RadialProfile, PoolsReplicatesAndTellsHowTheirMeansDiffer) {
    const Replicates replicates{samples_of([](double) { return 1.0; }),
                                samples_of([](double) { return 3.0; })};
    for (const ProfilePoint& point : pooled_profile(replicates)) {
        EXPECT_NEAR(point.mean, 2.0, 1e-12);
        EXPECT_NEAR(point.spread, 1.0, 1e-12);
        EXPECT_NEAR(point.standard_error, std::sqrt(2.0) / std::sqrt(2.0), 1e-12);
        EXPECT_EQ(point.n_replicates, 2);
    }
}

TEST(RadialProfile, LeavesOutBinsWithFewProbesAndValuesThatAreUndefined) {
    std::vector<ProbeSample> few;
    for (int i = 0; i < 9; ++i) few.push_back({0.51, 1.0});
    for (int i = 0; i < 10; ++i) few.push_back({0.56, 1.0});
    few.push_back({0.56, std::nan("")});
    const auto profile = pooled_profile(Replicates{few});
    ASSERT_EQ(profile.size(), 1U);
    EXPECT_EQ(profile[0].n_probes, 10);
    EXPECT_EQ(profile[0].mean, 1.0);
}

TEST(RadialProfile, CrossesZeroWhereItDoesSoForTheLastTimeAndPeaksOutsideOfIt) {
    // Noise in the middle is above zero, and higher than the rim.
    const auto profile = pooled_profile(Replicates{samples_of([](double r) {
        return r < 0.1 ? 5.0 : r < 1.0 ? r - 0.6 : 1.4 - r;
    })});
    EXPECT_NEAR(zero_crossing(profile), 0.6, 0.01);
    EXPECT_NEAR(peak(profile), 0.975, 0.03);
}

TEST(RadialProfile, ThatStaysOnOneSideHasNoCrossing) {
    EXPECT_TRUE(std::isnan(
        zero_crossing(pooled_profile(Replicates{samples_of([](double) { return -1.0; })}))));
}

}  // namespace
}  // namespace spheroscope::statistics
