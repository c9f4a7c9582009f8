#pragma once

#include "engine/forces/force_term.hpp"

namespace spheroscope {

/// Force of a tension gamma on node i of the triangle (i, j, k), counter-clockwise seen from
/// outside, nN: -gamma dS/dx_i, which pulls i towards the opposite side. Eqn (11), whose sign holds
/// for this winding.
[[nodiscard]] inline Vec3 tension_force_nN(double gamma_nN_per_um, const Vec3& j_um,
                                           const Vec3& k_um, const Vec3& normal) {
    return 0.5 * gamma_nN_per_um * (k_um - j_um).cross(normal);
}

struct ActiveTensionParameters {
    double gamma_nN_per_um = 0.0;
};

/// The cortex's active tension, eqn (11): energy gamma times area.
class ActiveTension final : public ForceTerm {
  public:
    /// Throws Error unless gamma >= 0.
    ActiveTension(Loc loc, const ActiveTensionParameters& parameters);

    [[nodiscard]] std::string_view name() const override { return "cortex.tension"; }
    [[nodiscard]] Need needs() const override { return Need::triangles; }
    void add_force(const Configuration& at, int cell, std::span<Vec3> F_nN) const override;
    [[nodiscard]] std::optional<double> energy_fJ(const Configuration& at, int cell) const override;
    /// Second variation of the area for displacements along each triangle's normal; the in-plane
    /// part of the second derivative is indefinite and left out.
    void add_stiffness(const Configuration& at, int cell, CellStiffness& K) const override;

    [[nodiscard]] double gamma_nN_per_um() const { return gamma_nN_per_um_; }

  private:
    double gamma_nN_per_um_;
};

}  // namespace spheroscope
