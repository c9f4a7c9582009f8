#pragma once

#include "engine/forces/force_term.hpp"

#include <vector>

namespace spheroscope {

/// Contact of two cells as a whole.
struct PairForce {
    int cell_a, cell_b;  ///< cell_a < cell_b
    double force_nN;     ///< F_ab . n_ab with n_ab from b to a: > 0 repulsion, < 0 adhesion
    double area_um2;     ///< sum of S_AB, one-sided
};

/// One row for each pair of cells with an active pair of triangles, ascending.
[[nodiscard]] std::vector<PairForce> pair_forces(const Configuration& at);

}  // namespace spheroscope
