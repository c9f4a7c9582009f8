#include "render/range.hpp"
#include "tests/render/synthetic.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace spheroscope::render {
namespace {

using synthetic::k_cell_field;
using synthetic::k_node_field;

TEST(Range, OfASignedFieldIsSymmetricAndRound) {
    RangeFinder finder(k_cell_field);
    finder.add(std::vector<float>{-0.037F, 0.0712F, 0.01F});  // kPa
    EXPECT_EQ(finder.range(), (Range{-80.0, 80.0})) << "Pa";
}

TEST(Range, OfAMagnitudeStartsAtZero) {
    RangeFinder finder(k_node_field);
    finder.add(std::vector<float>(1000, 0.5F));
    EXPECT_EQ(finder.range().low, 0.0);
    EXPECT_NEAR(finder.range().high, 0.6, 1e-12) << "0.5 lies in a bin that ends above it";
}

TEST(Range, LeavesOutlyingValuesOutButFewerThanOnePercent) {
    RangeFinder finder(k_cell_field);
    std::vector<float> values(10000, 0.05F);
    for (std::size_t i = 0; i < 45; ++i) values[i] = 3.0F;  // 0.45 %
    finder.add(values);
    EXPECT_LT(finder.range().high, 70.0);
    EXPECT_NEAR(finder.share_outside(finder.range()), 0.0045, 1e-12);
    for (std::size_t i = 45; i < 60; ++i) values[i] = 3.0F;  // 0.6 %: too many
    RangeFinder more(k_cell_field);
    more.add(values);
    EXPECT_GE(more.range().high, 3000.0);
}

TEST(Range, OfNoiseAboutZeroIsNotNoiseWide) {
    RangeFinder finder(k_cell_field);
    finder.add(std::vector<float>{1e-9F, -2e-9F, 0.0F});
    EXPECT_EQ(finder.range(), (Range{-1.0, 1.0})) << "1 Pa is the smallest half width";
}

TEST(Range, IgnoresWhatIsNotThere) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    RangeFinder finder(k_cell_field);
    finder.add(std::vector<float>{nan, 0.05F, nan});
    EXPECT_EQ(finder.n_values(), 1);
    EXPECT_EQ(finder.range(), (Range{-60.0, 60.0}));
}

TEST(Range, OfAMagnitudeThatIsOftenNegativeShowsIt) {
    RangeFinder finder(k_node_field);
    finder.add(std::vector<float>{-0.3F, 0.5F});
    EXPECT_LE(finder.range().low, -0.3);
}

TEST(NiceNumbers, RoundUpToAFewLeadingDigits) {
    EXPECT_DOUBLE_EQ(nice_ceil(0.5), 0.5);
    EXPECT_DOUBLE_EQ(nice_ceil(131.0), 150.0);
    EXPECT_DOUBLE_EQ(nice_ceil(8.1), 10.0);
    EXPECT_DOUBLE_EQ(nice_step(23.0), 20.0);
    EXPECT_DOUBLE_EQ(nice_step(0.0999), 0.05);
    EXPECT_DOUBLE_EQ(nice_step(50.0), 50.0);
}

TEST(Ticks, AreThreeToSevenRoundValuesInsideTheRange) {
    for (const double high : {1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0})
        for (const double low : {0.0, -high}) {
            const std::vector<double> values = ticks({low, high});
            EXPECT_GE(values.size(), 3U) << low << " to " << high;
            EXPECT_LE(values.size(), 7U) << low << " to " << high;
            EXPECT_GE(values.front(), low - 1e-12);
            EXPECT_LE(values.back(), high + 1e-12);
            bool has_zero = false;
            for (const double v : values) has_zero = has_zero || v == 0.0;
            EXPECT_TRUE(has_zero);
        }
}

}  // namespace
}  // namespace spheroscope::render
