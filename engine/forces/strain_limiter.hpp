#pragma once

#include "engine/forces/force_term.hpp"

namespace spheroscope {

/// Symmetric Dirichlet energy density of the map from a rest triangle to the current one (Smith and
/// Schaefer 2015), shifted to be 0 at rest: psi = I1 (1 + J^-2)/4 - 1 with I1 the trace of the
/// Cauchy-Green tensor and J the ratio of areas. About 2 s^2 for a small isotropic strain s;
/// infinite at zero area.
[[nodiscard]] constexpr double strain_measure(double I1, double J) {
    return 0.25 * I1 * (1.0 + 1.0 / (J * J)) - 1.0;
}

struct StrainLimiterParameters {
    double kappa_nN_per_um = 0.0;
    double psi0 = 0.1;  ///< silent below this strain measure: isotropic strains of -20 to +25 %
};

/// Keeps triangles of soft cortices (E t < gamma / 2) from collapsing. Not in the paper: there
/// springs alone hold the mesh, and springs this soft do not. Per triangle kappa S* g(psi) with
/// g = y^2/(y + psi0), y = max(0, psi - psi0): exactly zero within the silent range, continuous to
/// the first derivative, and growing like J^-2 towards zero area. Makes no net force or torque.
class StrainLimiter final : public ForceTerm {
  public:
    /// Throws Error unless kappa >= 0 and psi0 > 0.
    StrainLimiter(Loc loc, const StrainLimiterParameters& parameters);

    [[nodiscard]] std::string_view name() const override {
        return "cortex.regularisation.strain_limiter";
    }
    [[nodiscard]] Need needs() const override { return Need::none; }
    void add_force(const Configuration& at, int cell, std::span<Vec3> F_nN) const override;
    [[nodiscard]] std::optional<double> energy_fJ(const Configuration& at, int cell) const override;
    /// The positive parts of the second derivative; cotangents of obtuse rest angles are left out.
    void add_stiffness(const Configuration& at, int cell, CellStiffness& K) const override;

  private:
    StrainLimiterParameters parameters_;
};

}  // namespace spheroscope
