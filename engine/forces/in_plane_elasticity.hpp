#pragma once

#include "engine/forces/force_term.hpp"

namespace spheroscope {

/// Stiffness of the spring on an edge of rest length d_um between triangles of rest areas S, nN/um:
/// k = E t (S_A + S_B)/d^2, Van Gelder 1998. Scaling the mesh does not change it.
[[nodiscard]] constexpr double k_spring_nN_per_um(double E_kPa, double t_um, double S_A_um2,
                                                  double S_B_um2, double d_um) {
    return E_kPa * t_um * (S_A_um2 + S_B_um2) / (d_um * d_um);
}

/// Energy of one spring, fJ.
[[nodiscard]] inline double spring_energy_fJ(double k_nN_per_um, double rest_um, const Vec3& i_um,
                                             const Vec3& j_um) {
    const double stretch = (j_um - i_um).norm() - rest_um;
    return 0.5 * k_nN_per_um * stretch * stretch;
}

/// Force of one spring on node i, nN; on j it is the opposite. A stretched spring pulls i to j.
[[nodiscard]] inline Vec3 spring_force_nN(double k_nN_per_um, double rest_um, const Vec3& i_um,
                                          const Vec3& j_um) {
    const Vec3 e = j_um - i_um;
    return k_nN_per_um * (1.0 - rest_um / e.norm()) * e;
}

struct InPlaneElasticityParameters {
    double E_kPa = 0.0;
    double thickness_um = 0.0;
};

/// Springs on the edges, eqn (8), with k and d* of the rest shape. On a regular mesh they are a
/// sheet of Young's modulus E t and Poisson ratio 1/3.
class InPlaneElasticity final : public ForceTerm {
  public:
    /// Throws Error unless E and thickness are > 0.
    InPlaneElasticity(Loc loc, const InPlaneElasticityParameters& parameters);

    [[nodiscard]] std::string_view name() const override { return "cortex.elastic"; }
    [[nodiscard]] Need needs() const override { return Need::none; }
    void add_force(const Configuration& at, int cell, std::span<Vec3> F_nN) const override;
    [[nodiscard]] std::optional<double> energy_fJ(const Configuration& at, int cell) const override;
    /// The exact second derivative, but without the negative transverse part of compressed springs.
    void add_stiffness(const Configuration& at, int cell, CellStiffness& K) const override;

    [[nodiscard]] const InPlaneElasticityParameters& parameters() const { return parameters_; }

  private:
    InPlaneElasticityParameters parameters_;
};

}  // namespace spheroscope
