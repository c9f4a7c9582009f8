#include "engine/statistics/seed_mean.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace spheroscope::statistics {
namespace {

constexpr double k_nan = std::numeric_limits<double>::quiet_NaN();

TEST(SeedMean, IsTheMeanWithItsStandardErrorOverTheSeedsThatHaveANumber) {
    const Estimate estimate = mean_over_seeds(std::array{1.0, k_nan, 2.0, 3.0});
    EXPECT_DOUBLE_EQ(estimate.mean, 2.0);
    EXPECT_DOUBLE_EQ(estimate.standard_error, 1.0 / std::sqrt(3.0));
    EXPECT_EQ(estimate.n, 3);
}

TEST(SeedMean, OfOneSeedHasNoError) {
    const Estimate estimate = mean_over_seeds(std::array{5.0});
    EXPECT_EQ(estimate.mean, 5.0);
    EXPECT_TRUE(std::isnan(estimate.standard_error));
}

TEST(SeedMean, OfNothingIsUndefined) {
    const Estimate estimate = mean_over_seeds(std::array{k_nan});
    EXPECT_TRUE(std::isnan(estimate.mean));
    EXPECT_EQ(estimate.n, 0);
}

TEST(SeedMean, OfTheSameNumberInAllSeedsHasNoErrorOfItsRounding) {
    const double Z = 6.461538461538462;  // three of it, over three, are another number
    const Estimate estimate = mean_over_seeds(std::array{Z, k_nan, Z, Z});
    EXPECT_EQ(estimate.mean, Z);
    EXPECT_EQ(estimate.standard_error, 0.0);
    EXPECT_EQ(estimate.n, 3);
}

}  // namespace
}  // namespace spheroscope::statistics
