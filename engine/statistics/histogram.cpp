#include "engine/statistics/histogram.hpp"

#include <algorithm>
#include <cmath>

namespace spheroscope::statistics {

double Histogram::density_error(std::size_t bin) const {
    return std::sqrt(static_cast<double>(counts[bin])) / (n * width);
}

int doane_bins(std::span<const double> values) {
    const auto n = static_cast<double>(values.size());
    if (n < 3.0) return 1;
    double mean = 0.0, second = 0.0, third = 0.0;
    for (const double value : values) mean += value / n;
    for (const double value : values) {
        second += (value - mean) * (value - mean) / n;
        third += std::pow(value - mean, 3) / n;
    }
    if (second <= 0.0) return 1;
    const double skewness = third / std::pow(second, 1.5);
    const double s = std::sqrt(6.0 * (n - 2.0) / ((n + 1.0) * (n + 3.0)));
    return static_cast<int>(
        std::ceil(1.0 + std::log2(n) + std::log2(1.0 + std::abs(skewness) / s)));
}

Histogram doane_histogram(std::span<const double> values) {
    Histogram histogram;
    const auto n_bins = static_cast<std::size_t>(doane_bins(values));
    const double largest = *std::max_element(values.begin(), values.end());
    histogram.width = largest / static_cast<double>(n_bins);
    histogram.counts.assign(n_bins, 0);
    histogram.n = static_cast<int>(values.size());
    for (const double value : values) {
        const auto bin = static_cast<std::size_t>(value / histogram.width);
        ++histogram.counts[std::min(bin, n_bins - 1)];
    }
    return histogram;
}

}  // namespace spheroscope::statistics
