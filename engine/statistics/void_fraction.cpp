#include "engine/statistics/void_fraction.hpp"

#include <limits>

namespace spheroscope::statistics {

std::vector<ProbeSample> void_samples(const Aggregate& aggregate, const Probes& probes) {
    std::vector<ProbeSample> samples;
    for (std::size_t i = 0; i < probes.at_um.size(); ++i)
        samples.push_back({(probes.at_um[i] - aggregate.middle_um).norm() / aggregate.R_th_um,
                           probes.cell[i] < 0 ? 1.0 : 0.0});
    return samples;
}

double void_fraction(std::span<const ProbeSample> void_samples, double r_largest) {
    double sum = 0.0;
    int n = 0;
    for (const ProbeSample& sample : void_samples)
        if (sample.r <= r_largest) {
            sum += sample.value;
            ++n;
        }
    return n > 0 ? sum / n : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace spheroscope::statistics
