#pragma once

#include "engine/statistics/aggregate.hpp"

#include <array>
#include <span>
#include <string_view>
#include <vector>

namespace spheroscope::statistics {

/// Stress of one cell's contacts in four numbers, over its touching triangles, kPa; NaN: it
/// touches nothing.
struct CellStress {
    double mean_normal;       ///< mean of sigma_nn, tension positive
    double mean_shear;        ///< mean of the shear stress
    double anisotropic_max;   ///< 95th minus 5th percentile of sigma_nn
    double anisotropic_mean;  ///< standard deviation of sigma_nn
};

/// One row of the table of these numbers: figures and files loop over it.
struct CellStressRow {
    std::string_view quantity;  ///< "mean_normal_stress"
    std::string_view label;     ///< of axes
    double CellStress::*member;
};
[[nodiscard]] std::span<const CellStressRow> all_cell_stresses();

/// `equal`: each triangle counts once, as in the paper; the numbers then depend on the mesh.
/// `area`: each counts with its area.
enum class Weighting { equal, area };
[[nodiscard]] std::vector<CellStress> stress_of_cells(const Aggregate& aggregate,
                                                      Weighting weighting);

/// The value below which the share q of the weight lies: the k-th smallest of n values stands at
/// half the weight of itself and of all below it, scaled so that the smallest is at q = 0 and the
/// largest at q = 1, with straight lines between. For equal weights it is the usual quantile.
/// Precondition: n > 0, all weights > 0.
[[nodiscard]] double weighted_quantile(std::span<const double> values,
                                       std::span<const double> weights, double q);

}  // namespace spheroscope::statistics
