#pragma once

#include "engine/forces/force_term.hpp"

#include <numbers>

namespace spheroscope {

struct FoldStopParameters {
    double kappa_nN_per_um = 0.0;
    double fold_angle_rad = std::numbers::pi / 2.0;  ///< silent below this turn from the rest angle
};

/// Keeps soft cortices from folding over: per hinge k/2 (|theta - theta*| - fold angle)+^2 with k =
/// 2 kappa (S*_left + S*_right). Not in the paper; companion of the strain limiter, which cannot
/// see a fold. Exactly zero below the fold angle. At a turn of pi from rest the force changes sign;
/// the energy is continuous there. Makes no net force or torque.
class FoldStop final : public ForceTerm {
  public:
    /// Throws Error unless kappa >= 0 and the fold angle is between 0 and pi.
    FoldStop(Loc loc, const FoldStopParameters& parameters);

    [[nodiscard]] std::string_view name() const override {
        return "cortex.regularisation.fold_stop";
    }
    [[nodiscard]] Need needs() const override { return Need::none; }
    void add_force(const Configuration& at, int cell, std::span<Vec3> F_nN) const override;
    [[nodiscard]] std::optional<double> energy_fJ(const Configuration& at, int cell) const override;
    /// Gauss-Newton: k g g^T with the gradient g of the hinge angle.
    void add_stiffness(const Configuration& at, int cell, CellStiffness& K) const override;

  private:
    FoldStopParameters parameters_;
};

}  // namespace spheroscope
