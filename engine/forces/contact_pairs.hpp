#pragma once

#include "engine/forces/force_term.hpp"

namespace spheroscope {

/// Adds the forces of all contact pairs on one cell: f_i n on the nodes of A, -g_k n on those of B.
/// F_nN [n_nodes of the cell].
void add_pair_forces(const Configuration& at, int cell, std::span<Vec3> F_nN);

}  // namespace spheroscope
