#pragma once

#include <span>
#include <vector>

namespace spheroscope::statistics {

/// A probability density by counting in bins of equal width.
struct Histogram {
    double low = 0.0, width = 0.0;
    std::vector<int> counts;
    int n = 0;  ///< of all values

    [[nodiscard]] double middle(std::size_t bin) const {
        return low + (static_cast<double>(bin) + 0.5) * width;
    }
    [[nodiscard]] double density(std::size_t bin) const { return counts[bin] / (n * width); }
    /// Of the density: sqrt(count), the standard deviation of a Poisson variable, in its unit.
    [[nodiscard]] double density_error(std::size_t bin) const;
};

/// Number of bins by Doane (1976), which widens Sturges' rule for skewed values:
///   1 + log2 n + log2(1 + |g1| / s),   s^2 = 6 (n - 2) / ((n + 1)(n + 3)),
/// rounded up; g1 is the skewness.
[[nodiscard]] int doane_bins(std::span<const double> values);

/// From zero to the largest value, in doane_bins bins. Precondition: values >= 0, one of them > 0.
[[nodiscard]] Histogram doane_histogram(std::span<const double> values);

}  // namespace spheroscope::statistics
