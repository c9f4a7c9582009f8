#include "engine/statistics/seed_mean.hpp"

#include <cmath>

namespace spheroscope::statistics {

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
    double square = 0.0;
    for (const double value : values)
        if (!std::isnan(value)) square += (value - estimate.mean) * (value - estimate.mean);
    estimate.standard_error = std::sqrt(square / (estimate.n - 1) / estimate.n);
    return estimate;
}

}  // namespace spheroscope::statistics
