#pragma once

#include "engine/base/block3.hpp"
#include "engine/forces/cell_stiffness.hpp"
#include "engine/solve/node_couplings.hpp"

#include <span>
#include <vector>

namespace spheroscope {

/// What couples the nodes of one cell in (Gamma + dt K), summed up from elements once per linear
/// solve: an iteration then reads one block per pair of nodes, whatever the number of terms.
///
/// Elements that do not see a common translation are stored as blocks W_ij on differences,
/// y_i += W_ij (u_i - u_j), y_j -= W_ij^T (u_i - u_j): rounding to single precision then does not
/// touch that blindness, and the symmetry only within a node's own 3x3 block (by 1e-8).
class CellMatrix {
  public:
    /// The zero matrix. `couplings` must outlive this object.
    void clear(const NodeCouplings& couplings);
    /// += factor * K
    void add(const CellStiffness& K, double factor);
    /// The same isotropic coupling on all edges of the mesh: += strength * Laplacian.
    void add_laplacian(const MeshTopology& mesh, double strength);
    /// += factor * g g^T with g = weights[k] * direction at nodes[k], but without what the sum of
    /// the weights makes of it: for springs to nodes elsewhere, whose sum with these is zero.
    void add_between(const std::array<int, 3>& nodes, const std::array<double, 3>& weights,
                     const Vec3& direction, double factor);

    /// out += matrix * u; both [n_nodes].
    void add_product(std::span<const Vec3> u, std::span<Vec3> out) const;
    void add_product(std::span<const Lanes> u, std::span<Lanes> out) const;
    /// Adds the 3x3 diagonal blocks to `blocks` [n_nodes].
    void add_diagonal(std::span<Mat3> blocks) const;
    /// What it has against moving all nodes alike: T^T matrix T with T = (1, 1, ...).
    [[nodiscard]] Mat3 against_translation() const;
    /// The same of turning: R^T matrix R, where R_i omega = omega x arm[i], arm [n_nodes].
    [[nodiscard]] Mat3 against_rotation(std::span<const Vec3> arm) const;

  private:
    /// The block between two different nodes gets factor * g_i g_j^T of a squared form.
    void add_square(int i, int j, float factor, const std::array<float, 3>& g_i,
                    const std::array<float, 3>& g_j) {
        block(i, j).add_outer(-factor, i < j ? g_i : g_j, i < j ? g_j : g_i);
    }
    [[nodiscard]] Block3& block(int i, int j) {
        return blocks_[couplings_->pair(i < j ? i : j, i < j ? j : i)];
    }
    template <class Vector>
    void add_any_product(std::span<const Vector> u, std::span<Vector> out) const;

    const NodeCouplings* couplings_ = nullptr;
    std::vector<Block3> blocks_;              // [pairs of nodes] W
    std::vector<CellStiffness::Node> nodes_;  // what sees a translation: walls
};

}  // namespace spheroscope
