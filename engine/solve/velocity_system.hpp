#pragma once

#include "engine/forces/cell_stiffness.hpp"
#include "engine/solve/contact_operator.hpp"
#include "engine/solve/cortex_factor.hpp"

#include <memory>
#include <span>
#include <vector>

namespace spheroscope {

/// The linear system of one step, (Gamma + dt K) v = b, never assembled:
///
///   Gamma = drag (diagonal) + cortex (the mesh's Laplacian, shared by all cells) + contacts
///   (pairs) K     = elements of each cell (CellStiffness) + contacts (k S n n^T per pair) and per
///   cell one rank-one part, coefficient * S S^T with S = dV/dx: the derivative part of the volume
///   controller, and in an implicit method its stiffness.
///
/// With dt = 0 and no stiffness it is the friction matrix alone.
struct VelocitySystem {
    const Model& model;
    const Contacts& contacts;
    std::span<const double> drag;                ///< [all nodes]
    double edge_friction = 0.0;                  ///< 0: absent
    ContactOperator& pairs;                      ///< empty without contact friction and stiffness
    std::span<const CellStiffness> stiffness;    ///< [cells], or empty: dt K is left out
    double dt_s = 0.0;                           ///< factor of K
    std::span<const double> volume_coefficient;  ///< [cells], or empty: no rank-one part
    std::span<const Vec3> volume_gradient;       ///< S [all nodes]

    [[nodiscard]] int n_groups() const { return pairs.n_groups(); }
    /// A product is product_of_group for all groups, a barrier, then product_of_cell for all cells.
    void product_of_group(int group, std::span<const Vec3> u) const {
        pairs.product_of_group(group, model, dt_s, u);
    }
    /// out [n_nodes of the cell] = row block of the cell times u [all nodes].
    void product_of_cell(int cell, std::span<const Vec3> u, std::span<Vec3> out) const;
    /// The whole product, for tests, diagnostics and starts.
    void product(std::span<const Vec3> u, std::span<Vec3> out, Workers& workers) const;
};

/// An approximate inverse that treats every cell by itself. The rank-one volume part is inverted
/// exactly (Sherman and Morrison 1950), whatever the rest is: without it the iterations would
/// double.
class Preconditioner {
  public:
    virtual ~Preconditioner() = default;
    /// Prepares for this system, cells shared among the workers.
    void prepare(const VelocitySystem& system, Workers& workers);
    /// z = approximate inverse of the cell's block times r; both [n_nodes of the cell].
    void apply(int cell, std::span<const Vec3> r, std::span<Vec3> z) const;

  protected:
    virtual void allocate(const VelocitySystem& system) = 0;
    virtual void prepare_cell(const VelocitySystem& system, int cell) = 0;
    /// The same without the rank-one part.
    virtual void apply_base(int cell, std::span<const Vec3> r, std::span<Vec3> z) const = 0;

  private:
    const Model* model_ = nullptr;
    std::vector<Vec3> inverse_times_gradient_;  // [all nodes] w = B S
    std::vector<double> denominator_;           // [cells] 1/coefficient + S.w; 0: no rank-one part
};

/// 3x3 blocks of the diagonal: for (Gamma + dt K), where every direction has its own stiffness.
class BlockJacobi final : public Preconditioner {
  protected:
    void allocate(const VelocitySystem& system) override;
    void prepare_cell(const VelocitySystem& system, int cell) override;
    void apply_base(int cell, std::span<const Vec3> r, std::span<Vec3> z) const override;

  private:
    const Model* model_ = nullptr;
    std::vector<Mat3> inverse_;  // [all nodes]
};

/// The constant part of the friction matrix, factored once per cell size: exact without contacts
/// (then it is a direct solver), a good start with them.
class CortexPreconditioner final : public Preconditioner {
  public:
    /// Counts one factorisation for each distinct radius.
    [[nodiscard]] std::int64_t factorisations() const {
        return static_cast<std::int64_t>(factors_.size());
    }

  protected:
    void allocate(const VelocitySystem& system) override;
    void prepare_cell(const VelocitySystem&, int) override {}
    void apply_base(int cell, std::span<const Vec3> r, std::span<Vec3> z) const override;

  private:
    std::vector<std::unique_ptr<CortexFactor>> factors_;
    std::vector<std::size_t> factor_of_cell_;
};

/// Drag alone is diagonal: its inverse is a division.
class DragPreconditioner final : public Preconditioner {
  protected:
    void allocate(const VelocitySystem& system) override {
        drag_ = system.drag;
        model_ = &system.model;
    }
    void prepare_cell(const VelocitySystem&, int) override {}
    void apply_base(int cell, std::span<const Vec3> r, std::span<Vec3> z) const override;

  private:
    const Model* model_ = nullptr;
    std::span<const double> drag_;
};

}  // namespace spheroscope
