#pragma once

#include "engine/statistics/probes.hpp"

namespace spheroscope::statistics {

/// 1 for each probe that is in no cell, 0 for the others: their radial profile is the share of
/// space between cells, and outside of the aggregate.
[[nodiscard]] std::vector<ProbeSample> void_samples(const Aggregate& aggregate,
                                                    const Probes& probes);

/// The share of the probes within `r_largest` R_th that are in no cell; NaN without such probes.
/// Half of R_th is well below the surface: there it is the pores alone.
[[nodiscard]] double void_fraction(std::span<const ProbeSample> void_samples, double r_largest);

}  // namespace spheroscope::statistics
