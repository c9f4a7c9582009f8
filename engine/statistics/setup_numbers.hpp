#pragma once

#include "engine/statistics/run_statistics.hpp"
#include "engine/statistics/seed_mean.hpp"

#include <string>
#include <vector>

namespace spheroscope::statistics {

/// A number per seed, made of every run.
template <class F> [[nodiscard]] Estimate over_seeds(const SetupStatistics& setup, const F& value) {
    std::vector<double> values;
    for (const RunStatistics& run : setup.runs) values.push_back(value(run));
    return mean_over_seeds(values);
}

/// One number of a setup with its error over seeds.
struct SetupNumber {
    std::string name, unit;  ///< unit ASCII, "1": none
    Estimate estimate;
    /// [runs] in their order, NaN where undefined; empty for a number of all runs together.
    std::vector<double> by_run = {};
};

/// Everything that is one number per run, over the seeds of a setup: totals, regions, stresses of
/// cells, pores, depths of the profile, bulk modulus, contact forces, the balance of a droplet.
/// Some are of all runs together: depths of the pooled profile, whose error is the jackknife's (and
/// half a bin at least where a bin is what is found), and the exponent of the pooled forces, whose
/// error is the bootstrap's.
[[nodiscard]] std::vector<SetupNumber> numbers_of(const SetupStatistics& setup);

/// f = F / <F> of all runs of a setup together, each over its own mean.
[[nodiscard]] std::vector<double> pooled_forces(const SetupStatistics& setup, ForceNorm norm);

}  // namespace spheroscope::statistics
