#pragma once

#include "engine/base/lanes.hpp"
#include "engine/base/vec3.hpp"
#include "engine/model/mesh_topology.hpp"

#include <span>
#include <vector>

namespace spheroscope {

/// Cholesky factor of one cell's constant friction matrix, drag + cortex Laplacian (n_nodes x
/// n_nodes, the same for x, y and z). SuiteSparse's CHOLMOD (simplicial) orders and factors it
/// once; the triangular solves here run over x, y and z together, allocate nothing and may be
/// called by several threads at once.
class CortexFactor {
  public:
    /// drag [n_nodes], nN s/um, > 0.
    CortexFactor(const MeshTopology& mesh, std::span<const double> drag, double edge_friction);

    /// x = matrix^-1 b; both [n_nodes]; work [n_nodes] is scratch. x may be b. Vector: Vec3, or
    /// Lanes in single precision.
    template <class Vector>
    void solve(std::span<const Vector> b, std::span<Vector> x, std::span<Vector> work) const;

  private:
    std::vector<int> permutation_;
    std::vector<int> column_begin_, row_;  // L by columns, the diagonal first
    std::vector<double> value_;
};

}  // namespace spheroscope
