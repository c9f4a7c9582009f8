#pragma once

#include "engine/solve/cortex_factor.hpp"
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

  protected:
    using Scalar = typename VectorTraits<Vector>::Scalar;
    virtual void allocate(const VelocitySystem& system) = 0;
    virtual void prepare_cell(const VelocitySystem& system, int cell) = 0;
    /// The same without the rank-one part.
    virtual void apply_base(int cell, std::span<const Vector> r, std::span<Vector> z) const = 0;

  private:
    const Model* model_ = nullptr;
    std::vector<Vector> inverse_times_gradient_;  // [all nodes] w = B S
    std::vector<Scalar> denominator_;             // [cells] 1/coefficient + S.w; 0: no such part
};

/// Preconditions the conjugate gradients.
using Preconditioner = CellwiseInverse<Lanes>;

/// 3x3 blocks of the diagonal: for (Gamma + dt K), where every direction has its own stiffness.
/// Precondition of `prepare`: the system has its cell matrices.
class BlockJacobi final : public CellwiseInverse<Lanes> {
  protected:
    void allocate(const VelocitySystem& system) override;
    void prepare_cell(const VelocitySystem& system, int cell) override;
    void apply_base(int cell, std::span<const Lanes> r, std::span<Lanes> z) const override;

  private:
    const Model* model_ = nullptr;
    std::vector<std::array<Lanes, 3>> inverse_;  // [all nodes] columns
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
        drag_ = system.drag;
        model_ = &system.model;
    }
    void prepare_cell(const VelocitySystem&, int) override {}
    void apply_base(int cell, std::span<const Vector> r, std::span<Vector> z) const override;

  private:
    const Model* model_ = nullptr;
    std::span<const double> drag_;
};

}  // namespace spheroscope
