#pragma once

#include "engine/measures/pair_forces.hpp"

#include <array>
#include <span>

namespace spheroscope::statistics {

/// Contact areas, um^2, between which the touching threshold is varied: what Z depends on it.
inline constexpr std::array k_touching_thresholds_um2{0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0};

/// Z: mean number of cells that a cell touches with more than this area.
[[nodiscard]] double coordination(std::span<const PairForce> pairs, int n_cells,
                                  double touching_area_um2);

}  // namespace spheroscope::statistics
