#pragma once

#include "engine/model/mesh_topology.hpp"
#include "engine/solve/sparse_cholesky.hpp"

#include <span>

namespace spheroscope {

/// Cholesky factor of one cell's constant friction matrix, drag + cortex Laplacian (n_nodes x
/// n_nodes, the same for x, y and z, which are solved for together). Made once per run.
class CortexFactor {
  public:
    /// drag [n_nodes], nN s/um, > 0.
    CortexFactor(const MeshTopology& mesh, std::span<const double> drag_nN_s_per_um,
                 double edge_nN_s_per_um);

    /// x = matrix^-1 b; both [n_nodes]; work [n_nodes] is scratch. x may be b. Vector: Vec3, or
    /// Lanes in single precision.
    template <class Vector>
    void solve(std::span<const Vector> b, std::span<Vector> x, std::span<Vector> work) const {
        factor_.solve(b, x, work);
    }

  private:
    SparseCholesky factor_;
};

}  // namespace spheroscope
