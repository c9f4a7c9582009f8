#include "engine/base/random.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <thread>
#include <vector>

namespace spheroscope {
namespace {

constexpr std::uint64_t n_samples = 100'000;
const double root_n = std::sqrt(static_cast<double>(n_samples));

/// The uniform number that the first two 32-bit words of a Philox block stand for.
double uniform_of(std::uint64_t first, std::uint64_t second) {
    return (static_cast<double>(((first << 32U) | second) >> 11U) + 0.5) * 0x1.0p-53;
}

// Known answers of philox4x32-10 that Random123 publishes (kat_vectors).
TEST(Random, UniformIsPhiloxOfSeedStreamIndexAndComponent) {
    EXPECT_EQ(Random(0, 0).uniform(0, 0), uniform_of(0x6627e8d5, 0xe169c58d));
    EXPECT_EQ(Random(0xffffffffffffffff, 0xffffffff).uniform(0xffffffffffffffff, 0xffffffff),
              uniform_of(0x408f276d, 0x41c83b0e));
    // the digits of pi: every argument has its own word
    EXPECT_EQ(Random(0x299f31d0a4093822, 0x03707344).uniform(0x85a308d3243f6a88, 0x13198a2e),
              uniform_of(0xd16cfe09, 0x94fdcceb));
}

TEST(Random, ValuesDoNotDependOnTheOrderOrTheThreadThatAsks) {
    const Random random(7, 3);
    std::vector<double> forward;
    for (std::uint64_t i = 0; i < 1000; ++i) forward.push_back(random.normal(i));
    std::vector<double> backward(1000);
    std::thread([&] {
        for (std::uint64_t i = 1000; i-- > 0;) backward[i] = random.normal(i);
    }).join();
    EXPECT_EQ(forward, backward);
}

// Standard errors: sqrt(1/12 / n) of the mean, sqrt(1/180 / n) of the variance; four of them.
TEST(Random, UniformHasMeanOneHalfAndVarianceOneTwelfth) {
    const Random random(1, 1);
    double sum = 0.0;
    double sum_of_squares = 0.0;
    for (std::uint64_t i = 0; i < n_samples; ++i) {
        const double u = random.uniform(i);
        ASSERT_GT(u, 0.0);
        ASSERT_LT(u, 1.0);
        sum += u - 0.5;
        sum_of_squares += (u - 0.5) * (u - 0.5);
    }
    const auto n = static_cast<double>(n_samples);
    EXPECT_NEAR(sum / n, 0.0, 4.0 * std::sqrt(1.0 / 12.0) / root_n);
    EXPECT_NEAR(sum_of_squares / n, 1.0 / 12.0, 4.0 * std::sqrt(1.0 / 180.0) / root_n);
}

// Standard errors: of the mean 1, of the variance sqrt(2), of the fourth moment sqrt(96), over
// sqrt(n).
TEST(Random, NormalHasTheMomentsOfTheStandardNormal) {
    const Random random(1, 1);
    double m1 = 0.0;
    double m2 = 0.0;
    double m4 = 0.0;
    for (std::uint64_t i = 0; i < n_samples; ++i) {
        const double z = random.normal(i);
        m1 += z;
        m2 += z * z;
        m4 += z * z * z * z;
    }
    const auto n = static_cast<double>(n_samples);
    EXPECT_NEAR(m1 / n, 0.0, 4.0 / root_n);
    EXPECT_NEAR(m2 / n, 1.0, 4.0 * std::sqrt(2.0) / root_n);
    EXPECT_NEAR(m4 / n, 3.0, 4.0 * std::sqrt(96.0) / root_n);
}

/// Correlation of the first n_samples numbers of two sources; unrelated ones stay within four
/// standard errors, 4 / sqrt(n).
template <class First, class Second> double correlation(First first, Second second) {
    double sum = 0.0;
    for (std::uint64_t i = 0; i < n_samples; ++i) sum += (first(i) - 0.5) * (second(i) - 0.5);
    return 12.0 * sum / static_cast<double>(n_samples);
}

TEST(Random, SeedsStreamsComponentsAndNeighboursAreUnrelated) {
    const Random random(1, 1);
    const Random other_stream(1, 2);
    const Random other_seed(2, 1);
    const auto first = [&](std::uint64_t i) { return random.uniform(i); };
    EXPECT_NEAR(correlation(first, first), 1.0, 0.02);  // the control: a copy is noticed
    EXPECT_NEAR(correlation(first, [&](auto i) { return other_stream.uniform(i); }), 0.0,
                4.0 / root_n);
    EXPECT_NEAR(correlation(first, [&](auto i) { return other_seed.uniform(i); }), 0.0,
                4.0 / root_n);
    EXPECT_NEAR(correlation(first, [&](auto i) { return random.uniform(i, 1); }), 0.0,
                4.0 / root_n);
    EXPECT_NEAR(correlation(first, [&](auto i) { return random.uniform(i + 1); }), 0.0,
                4.0 / root_n);
}

}  // namespace
}  // namespace spheroscope
