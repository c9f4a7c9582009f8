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

TEST(TailFit, ThatEndsAtABoundOfBetaIsNone) {
    // As many between 1 and 2 everywhere: no exponent is small enough.
    std::vector<double> flat;
    for (int i = 0; i < 400; ++i) flat.push_back((i + 0.5) / 200.0);
    const TailFit low = fit_tail(flat, TailScale::one);
    EXPECT_FALSE(low.exists());
    EXPECT_EQ(low.reason, "beta ends at its bound, 0.1");
    EXPECT_EQ(low.gap(), low.reason);
    // Nearly all in the first bin above 1: none is large enough.
    std::vector<double> steep(300, 0.3);
    steep.resize(2000, 1.05);
    for (const double f : {1.9, 2.5, 3.0}) steep.push_back(f);
    EXPECT_FALSE(fit_tail(steep, TailScale::one).exists());
}

TEST(TailFit, HasNoErrorWhereManySamplesHaveNoFit) {
    // One force fills the third bin: a sample is without it with a chance of 1/e.
    std::vector<double> f(100, 0.4);
    f.resize(140, 1.2);
    f.resize(145, 2.0);
    f.push_back(3.0);
    const TailFit fit = fit_tail(f, TailScale::one);
    ASSERT_TRUE(fit.exists()) << fit.reason;
    EXPECT_EQ(fit.n_samples, 200);
    EXPECT_GT(fit.n_failed_samples, 40);
    EXPECT_TRUE(std::isnan(fit.beta_error));
    EXPECT_EQ(fit.gap(), "no error, " + std::to_string(fit.n_failed_samples) +
                             " of 200 bootstrap samples have no fit");
    EXPECT_EQ(fit_tail(exponential_forces(4000, 1), TailScale::one, 1, 20).n_failed_samples, 0);
}

}  // namespace
}  // namespace spheroscope::statistics
