#pragma once

#include "engine/base/huge_vector.hpp"
#include "engine/solve/cortex_factor.hpp"
#include "engine/solve/rigid_motions.hpp"
#include "engine/solve/velocity_system.hpp"

#include <memory>
#include <span>
#include <vector>

namespace spheroscope {

/// An inverse, exact or approximate, that treats every cell by itself. The rank-one volume part is
/// inverted exactly (Sherman and Morrison 1950), whatever the rest is: without it the iterations
/// would double. Vector: Vec3 for direct solves, Lanes for the preconditioner of the iterations.
template <class Vector> class CellwiseInverse {
  public:
    virtual ~CellwiseInverse() = default;
    /// Prepares for this system, cells shared among the workers.
    void prepare(const VelocitySystem& system, Workers& workers);
    /// z = inverse of the cell's block times r; both [n_nodes of the cell].
    void apply(int cell, std::span<const Vector> r, std::span<Vector> z) const;
    /// What couples cells, and is to be added to the inverses of all of them; nullptr: nothing.
    [[nodiscard]] virtual const RigidMotions* rigid_motions() const { return nullptr; }

  protected:
    using Scalar = typename VectorTraits<Vector>::Scalar;
    virtual void allocate(const VelocitySystem& system) = 0;
    virtual void prepare_cell(const VelocitySystem& system, int cell) = 0;
    /// After all cells have been prepared.
    virtual void prepare_coupling(const VelocitySystem&, Workers&) {}
    /// The same without the rank-one part.
    virtual void apply_base(int cell, std::span<const Vector> r, std::span<Vector> z) const = 0;

  private:
    const Model* model_ = nullptr;
    HugeVector<Vector> inverse_times_gradient_;  // [all nodes] w = B S
    std::vector<Scalar> denominator_;            // [cells] 1/coefficient + S.w; 0: no such part
};

/// Preconditions the conjugate gradients.
using Preconditioner = CellwiseInverse<Lanes>;

/// For (Gamma + dt K), where every direction has its own stiffness: 3x3 blocks of the diagonal, and
/// in long steps the motions of whole cells. Precondition of `prepare`: the system has its cell
/// matrices.
class BlockJacobi final : public CellwiseInverse<Lanes> {
  public:
    /// Where friction is most of the matrix the blocks see all motions alike, and a step of 8 ms
    /// gets slower by a tenth with the motions of whole cells.
    static constexpr double k_stiff = 2.0;
    /// stiff: the trace of (Gamma + dt K) over that of drag and cortex from which on the motions of
    /// whole cells are treated by themselves. 0: always; infinity: never.
    explicit BlockJacobi(double stiff = k_stiff) : stiff_(stiff) {}

    [[nodiscard]] const RigidMotions* rigid_motions() const override {
        return motions_.is_in_use() ? &motions_ : nullptr;
    }

  protected:
    void allocate(const VelocitySystem& system) override;
    void prepare_cell(const VelocitySystem& system, int cell) override;
    void prepare_coupling(const VelocitySystem& system, Workers& workers) override;
    void apply_base(int cell, std::span<const Lanes> r, std::span<Lanes> z) const override;

  private:
    double stiff_;
    const Model* model_ = nullptr;
    HugeVector<std::array<Lanes, 3>> inverse_;  // [all nodes] columns
    std::vector<double> trace_;                 // [cells] of the diagonal blocks
    std::vector<Vec3> middle_um_;               // [cells]
    std::vector<Mat3> resistance_;              // [cells], see RigidMotions::prepare
    RigidMotions motions_;
};

/// The constant part of the friction matrix, factored once per cell size: exact without contacts
/// (then it is a direct solver), a good start with them.
template <class Vector> class CortexInverse final : public CellwiseInverse<Vector> {
  public:
    /// Counts one factorisation for each distinct radius.
    [[nodiscard]] std::int64_t factorisations() const {
        return static_cast<std::int64_t>(factors_.size());
    }

  protected:
    void allocate(const VelocitySystem& system) override;
    void prepare_cell(const VelocitySystem&, int) override {}
    void apply_base(int cell, std::span<const Vector> r, std::span<Vector> z) const override;

  private:
    std::vector<std::unique_ptr<CortexFactor>> factors_;
    std::vector<std::size_t> factor_of_cell_;
};

/// Drag alone is diagonal: its inverse is a division.
template <class Vector> class DragInverse final : public CellwiseInverse<Vector> {
  protected:
    void allocate(const VelocitySystem& system) override {
        drag_nN_s_per_um_ = system.drag_nN_s_per_um;
        model_ = &system.model;
    }
    void prepare_cell(const VelocitySystem&, int) override {}
    void apply_base(int cell, std::span<const Vector> r, std::span<Vector> z) const override;

  private:
    const Model* model_ = nullptr;
    std::span<const double> drag_nN_s_per_um_;
};

}  // namespace spheroscope
