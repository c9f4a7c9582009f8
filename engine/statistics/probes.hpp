#pragma once

#include "engine/statistics/aggregate.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace spheroscope::statistics {

/// Points at which an aggregate is looked at (paper, Appendix C), and the cell that each is in.
struct Probes {
    std::vector<Vec3> at_um;
    std::vector<int> cell;  ///< -1: in no cell
};

/// Probes inside the sphere of volume of all cells, as in the paper.
inline constexpr int k_probes_inside = 10000;
/// How far probes reach, in R_th: loose aggregates are larger than the sphere of their volume.
inline constexpr double k_probe_reach = 1.2;

/// Random points, uniform in the ball of k_probe_reach R_th about the middle, so many that n_inside
/// of them are expected within R_th.
[[nodiscard]] std::vector<Vec3> random_points_um(const Aggregate& aggregate, std::uint64_t seed,
                                                 int n_inside = k_probes_inside);
/// The same, and the cells that they are in.
[[nodiscard]] Probes random_probes(const Aggregate& aggregate, std::uint64_t seed,
                                   int n_inside = k_probes_inside);

/// The cell whose closed surface a point is in, for each point; -1: none. The lowest one where
/// cells overlap.
[[nodiscard]] std::vector<int> cells_around(const Aggregate& aggregate,
                                            std::span<const Vec3> points_um);

/// How a probe gets its value from the values of cells, which stand at their centres.
enum class Interpolation {
    nearest_cell,
    inverse_distance,  ///< the k_neighbours nearest, weighted with 1 / distance^2 (Shepard 1968)
};
inline constexpr int k_neighbours = 8;

/// A number at a distance from the middle.
struct ProbeSample {
    double r;  ///< over R_th
    double value;
};

/// The values of cells as the probes see them. A probe beyond R_th counts only inside a cell:
/// farther out there is no tissue. Of those within R_th nobody asks which cell they are in.
[[nodiscard]] std::vector<ProbeSample> sample_cells(const Aggregate& aggregate,
                                                    const Probes& probes,
                                                    std::span<const double> cell_values,
                                                    Interpolation interpolation);

}  // namespace spheroscope::statistics
