#pragma once

#include "engine/forces/force_term.hpp"

namespace spheroscope {

/// k_bend = factor * E t^3 / 12(1 - nu^2), eqn (10), fJ. With factor 1 (the paper) a regular sheet
/// bends with 0.866 of the plate's rigidity; factor 2/sqrt(3) gives the plate's.
[[nodiscard]] constexpr double k_bend_fJ(double E_kPa, double t_um, double poisson, double factor) {
    return factor * E_kPa * t_um * t_um * t_um / (12.0 * (1.0 - poisson * poisson));
}

/// Energy of one hinge, eqn (9): k (1 - cos(theta - theta*)), fJ, without cancellation near rest.
[[nodiscard]] double hinge_energy_fJ(double k_fJ, double theta_rad, double rest_rad);

struct BendingParameters {
    double E_kPa = 0.0;
    double thickness_um = 0.0;
    double poisson = 1.0 / 3.0;
    double factor = 1.0;  ///< on k_bend
};

/// Resistance of the hinges to leave their rest angle, eqns (9) and (10).
class Bending final : public ForceTerm {
  public:
    /// Throws Error unless E, thickness, factor are > 0 and the Poisson ratio is in (-1, 1).
    Bending(Loc loc, const BendingParameters& parameters);

    [[nodiscard]] std::string_view name() const override { return "cortex.bending"; }
    [[nodiscard]] Need needs() const override { return Need::none; }
    void add_force(const Configuration& at, int cell, std::span<Vec3> F_nN) const override;
    [[nodiscard]] std::optional<double> energy_fJ(const Configuration& at, int cell) const override;
    /// Gauss-Newton: k max(0, cos(theta - theta*)) g g^T, exact at the rest angle.
    void add_stiffness(const Configuration& at, int cell, CellStiffness& K) const override;

    [[nodiscard]] double k_fJ() const { return k_fJ_; }

  private:
    double k_fJ_;
};

}  // namespace spheroscope
