#include "engine/statistics/seed_mean.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace spheroscope::statistics {
namespace {

/// The least and the greatest of the numbers that there are.
std::pair<double, double> range_of(std::span<const double> values) {
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (const double value : values)
        if (!std::isnan(value)) {
            least = std::min(least, value);
            most = std::max(most, value);
        }
    return {least, most};
}

}  // namespace

Estimate mean_over_seeds(std::span<const double> values) {
    Estimate estimate;
    double sum = 0.0;
    for (const double value : values)
        if (!std::isnan(value)) {
            sum += value;
            ++estimate.n;
        }
    if (estimate.n == 0) return estimate;
    estimate.mean = sum / estimate.n;
    if (estimate.n < 2) return estimate;
    // The same number in all seeds has no error, and none that rounding makes.
    if (const auto [least, most] = range_of(values); least == most) {
        estimate.mean = least;
        estimate.standard_error = 0.0;
        return estimate;
    }
    double square = 0.0;
    for (const double value : values)
        if (!std::isnan(value)) square += (value - estimate.mean) * (value - estimate.mean);
    estimate.standard_error = std::sqrt(square / (estimate.n - 1) / estimate.n);
    return estimate;
}

}  // namespace spheroscope::statistics
