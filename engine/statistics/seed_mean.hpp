#pragma once

#include <limits>
#include <span>

namespace spheroscope::statistics {

/// What several seeds say about one number.
struct Estimate {
    double mean = std::numeric_limits<double>::quiet_NaN();
    /// Of the mean: sample standard deviation over sqrt(n); NaN below two seeds.
    double standard_error = std::numeric_limits<double>::quiet_NaN();
    int n = 0;  ///< seeds in which the number is defined
};

/// Mean and standard error of one value per seed. NaN ('undefined in this seed') is left out, and
/// `n` says so.
[[nodiscard]] Estimate mean_over_seeds(std::span<const double> values);

}  // namespace spheroscope::statistics
