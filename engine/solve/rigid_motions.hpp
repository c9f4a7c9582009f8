#pragma once

#include "engine/base/huge_vector.hpp"
#include "engine/base/workers.hpp"
#include "engine/solve/sparse_cholesky.hpp"
#include "engine/solve/velocity_system.hpp"

#include <span>
#include <vector>

namespace spheroscope {

/// The part of a preconditioner that moves and turns whole cells,
///
///     z += P (P^T A P)^-1 P^T r,   A = Gamma + dt K,   P: one cell as a rigid body.
///
/// Cells that slide past each other and turn in their pockets strain nothing: only friction holds
/// them, so in a long step these motions are a hundred times softer than any block of the diagonal
/// shows, and block Jacobi alone needs a hundred iterations to find them. Translations couple all
/// cells (a sparse matrix of three unknowns a cell); rotations count cell by cell, their coupling
/// was measured not to matter (engine/README.md, 'Linear solves').
///
/// Neither changes a cell's volume: sum S = sum x_i x S_i = 0. So the volume part of the
/// preconditioner does not see them.
class RigidMotions {
  public:
    /// Precondition: the system has its cell matrices. resistance [cells]: sum over the cell's
    /// nodes of [r_i] B_i [r_i]^T with r_i from the cell's middle, [r] u = r x u, and B_i what
    /// holds node i against the world outside of the cell.
    void prepare(const VelocitySystem& system, std::span<const Vec3> middle_um,
                 std::span<const Mat3> resistance, Workers& workers);
    void leave_out() { is_in_use_ = false; }
    /// False as well when the translations have no definite matrix, as of cells that nothing holds:
    /// then the rest of the preconditioner does what it can, with more iterations.
    [[nodiscard]] bool is_in_use() const { return is_in_use_; }

    /// The angular velocity that the forces r [n_nodes of the cell] on it ask for.
    [[nodiscard]] Lanes turning(int cell, std::span<const Lanes> r) const;
    /// z += turning x r_i; both [n_nodes of the cell].
    void add_turning(int cell, Lanes turning, std::span<Lanes> z) const;

    /// Velocities of all cells that the forces on them ask for, x, y, z of one after the other; all
    /// [3 cells], work is scratch. May be called by several threads at once.
    void translations(std::span<const double> force, std::span<double> velocity,
                      std::span<double> work) const {
        coupled_.solve(force, velocity, work);
    }

  private:
    [[nodiscard]] bool factor_translations(const VelocitySystem& system);

    bool is_in_use_ = false;
    const Model* model_ = nullptr;
    HugeVector<Lanes> arm_um_;                      // [all nodes] r_i
    std::vector<std::array<Lanes, 3>> compliance_;  // [cells] inverse of a rotation's resistance
    std::vector<Mat3> of_pairs_;                    // [groups]
    SparseCholesky coupled_;
};

}  // namespace spheroscope
