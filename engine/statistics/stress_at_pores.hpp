#pragma once

#include "engine/statistics/aggregate.hpp"

namespace spheroscope::statistics {

/// Mean contact stress sigma_nn on the touching triangles of core cells, kPa, weighted with their
/// areas; positive is adhesion that pulls. NaN: there is no such triangle.
struct StressAtPores {
    double at_pores_kPa;   ///< triangles with a node that a free triangle has as well
    double elsewhere_kPa;  ///< all others
};
/// What pores do to the contacts around them.
[[nodiscard]] StressAtPores stress_at_pores(const Aggregate& aggregate);

}  // namespace spheroscope::statistics
