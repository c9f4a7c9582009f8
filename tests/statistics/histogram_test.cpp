#include "engine/statistics/histogram.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace spheroscope::statistics {
namespace {

TEST(DoaneBins, WithoutSkewnessAreThoseOfSturges) {
    std::vector<double> values;
    for (int i = 0; i < 1024; ++i) values.push_back(i + 0.5);
    EXPECT_EQ(doane_bins(values), 11) << "1 + log2 1024";
}

TEST(DoaneBins, OfASkewedSampleAreMoreByItsSkewness) {
    // 96 zeros and 4 ones: g1 = (1 - 2p) / sqrt(p (1 - p)), p = 0.04
    std::vector<double> values(100, 0.0);
    for (std::size_t i = 0; i < 4; ++i) values[i] = 1.0;
    const double g1 = 0.92 / std::sqrt(0.04 * 0.96);
    const double s = std::sqrt(6.0 * 98.0 / (101.0 * 103.0));
    EXPECT_EQ(doane_bins(values),
              static_cast<int>(std::ceil(1.0 + std::log2(100.0) + std::log2(1.0 + g1 / s))));
}

TEST(DoaneHistogram, IsADensityFromZeroToTheLargestValue) {
    std::vector<double> values;
    for (int i = 1; i <= 1000; ++i) values.push_back(-std::log((i - 0.5) / 1000.0));
    const Histogram histogram = doane_histogram(values);
    double area = 0.0;
    int n = 0;
    for (std::size_t bin = 0; bin < histogram.counts.size(); ++bin) {
        area += histogram.density(bin) * histogram.width;
        n += histogram.counts[bin];
    }
    EXPECT_NEAR(area, 1.0, 1e-12);
    EXPECT_EQ(n, 1000) << "the largest value is in the last bin";
    const double w = histogram.width;
    EXPECT_NEAR(histogram.density(0), (1.0 - std::exp(-w)) / w, 2e-3);
    EXPECT_NEAR(histogram.density_error(0), histogram.density(0) / std::sqrt(histogram.counts[0]),
                1e-12);
}

TEST(DoaneHistogram, OfEqualValuesHasOneBin) {
    EXPECT_EQ(doane_histogram(std::array{2.0, 2.0, 2.0, 2.0}).counts, std::vector{4});
}

}  // namespace
}  // namespace spheroscope::statistics
