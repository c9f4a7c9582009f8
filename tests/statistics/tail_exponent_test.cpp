#include "engine/base/random.hpp"
#include "engine/statistics/tail_exponent.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace spheroscope::statistics {
namespace {

/// P = exp(-f): mean 1.
std::vector<double> exponential_forces(int n, std::uint64_t seed) {
    const Random random(seed, 99);
    std::vector<double> f;
    for (int i = 0; i < n; ++i)
        f.push_back(-std::log(random.uniform(static_cast<std::uint64_t>(i))));
    return f;
}

/// P ~ exp(-(f / scale)^2).
std::vector<double> gaussian_forces(int n, double scale) {
    const Random random(1, 99);
    std::vector<double> f;
    for (int i = 0; i < n; ++i)
        f.push_back(std::abs(random.normal(static_cast<std::uint64_t>(i))) * scale /
                    std::numbers::sqrt2);
    return f;
}

TEST(TailFit, FindsOneForAnExponentialWithinTwiceItsError) {
    const std::vector<double> f = exponential_forces(4000, 1);
    const TailFit fit = fit_tail(f, TailScale::one, 1, 60);
    ASSERT_TRUE(fit.exists()) << fit.reason;
    EXPECT_NEAR(fit.beta, 1.0, 2 * fit.beta_error);
    EXPECT_GT(fit.beta_error, 0.002);
    EXPECT_LT(fit.beta_error, 0.03);
    EXPECT_NEAR(fit.a, 1.0, 0.06);
    EXPECT_EQ(fit.b, 1.0);
}

TEST(TailFit, FindsTwoForAGaussianOfUnitScale) {
    const TailFit fit = fit_tail(gaussian_forces(4000, 1.0), TailScale::one, 1, 60);
    ASSERT_TRUE(fit.exists()) << fit.reason;
    EXPECT_NEAR(fit.beta, 2.0, 2 * fit.beta_error + 0.05);
}

TEST(TailFit, OfAGaussianOverItsMeanNeedsItsScaleFree) {
    const std::vector<double> f = gaussian_forces(20000, std::sqrt(std::numbers::pi));
    EXPECT_NEAR(fit_tail(f, TailScale::one, 1, 2).beta, 1.2, 0.05);
    const TailFit fit = fit_tail(f, TailScale::free, 1, 2);
    EXPECT_NEAR(fit.beta, 2.0, 0.25);
    EXPECT_NEAR(fit.b, 1.0 / std::numbers::pi, 0.15);
}

TEST(TailFit, HasTheErrorThatRepeatedExperimentsHave) {
    double sum = 0.0, square = 0.0;
    constexpr int n = 12;
    for (std::uint64_t seed = 1; seed <= n; ++seed) {
        const double beta = fit_tail(exponential_forces(750, seed), TailScale::one, 1, 0).beta;
        sum += beta;
        square += beta * beta;
    }
    const double scatter = std::sqrt((square - sum * sum / n) / (n - 1));
    const double error = fit_tail(exponential_forces(750, 1), TailScale::one, 1, 60).beta_error;
    EXPECT_GT(error / scatter, 0.5);
    EXPECT_LT(error / scatter, 2.0);
    EXPECT_NEAR(sum / n, 1.0, 3 * scatter / std::sqrt(n)) << "no bias";
}

TEST(TailFit, OfFewForcesSaysWhyThereIsNone) {
    const TailFit few = fit_tail(exponential_forces(40, 1), TailScale::one);
    EXPECT_FALSE(few.exists());
    EXPECT_NE(few.reason.find("forces lie above the mean"), std::string::npos) << few.reason;
    std::vector<double> two_values(100, 0.5);
    two_values.resize(200, 1.5);
    EXPECT_NE(fit_tail(two_values, TailScale::one).reason.find("bins"), std::string::npos);
}

}  // namespace
}  // namespace spheroscope::statistics
