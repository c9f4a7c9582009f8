#pragma once

#include "engine/forces/force_term.hpp"

#include <limits>

namespace spheroscope {

/// P_off = (2 gamma/3) A/V, kPa: balances a tension gamma on a closed mesh of this area and volume
/// under uniform scaling. On a sphere it is the paper's 2 gamma/R; on a mesh it leaves no net
/// expansion.
[[nodiscard]] constexpr double offset_pressure_kPa(double gamma_nN_per_um, double area_um2,
                                                   double volume_um3) {
    return 2.0 * gamma_nN_per_um / 3.0 * area_um2 / volume_um3;
}

struct CytosolPressureParameters {
    double K_kPa = 0.0;
    double T_I_s = std::numeric_limits<double>::infinity();  ///< infinite: no integral part
    double T_d_s = 0.0;                                      ///< 0: no derivative part
    double extra_pressure_kPa = 0.0;
    double gamma_nN_per_um = 0.0;  ///< what the offset pressure balances; 0 without a tension
    /// V = V* is a constraint. P = P_off + P_extra - (K/T_I) I, where I is no integral but what the
    /// constraint asks for; K/T_I is its unit only.
    bool is_exact = false;
};

/// Pressure of the cytosol on the membrane, eqns (12) and (13): F_i = P dV/dx_i with
/// P = P_off + P_extra - K eps - (K/T_I) I - K T_d eps', eps = (V - V*)/V*, I' = eps.
///
/// Only the parts that depend on the configuration act here. The derivative part is a friction,
/// (K T_d/V*) S S^T with S = dV/dx: the methods treat it implicitly (an explicit one grows 144-fold
/// per step at the paper's values), and also the stiffness (K/V*) S S^T, of rank one over the whole
/// cell.
class CytosolPressure final : public ForceTerm {
  public:
    /// Throws Error unless K >= 0, T_I > 0, T_d >= 0 and the others are finite.
    CytosolPressure(Loc loc, const CytosolPressureParameters& parameters);

    [[nodiscard]] std::string_view name() const override { return "cytosol"; }
    [[nodiscard]] Need needs() const override { return Need::volumes; }
    void add_force(const Configuration& at, int cell, std::span<Vec3> F_nN) const override;
    /// F = -dE/dx at a constant integral; with the integral part this E need not fall. Zero at V*.
    [[nodiscard]] std::optional<double> energy_fJ(const Configuration& at, int cell) const override;

    /// eps = (V - V*)/V*.
    [[nodiscard]] double volume_strain(const Configuration& at, int cell) const;
    /// P without the derivative part.
    [[nodiscard]] double pressure_kPa(const Configuration& at, int cell) const;
    /// P_off of this cell, from its rest mesh.
    [[nodiscard]] double offset_kPa(const Model& model, int cell) const;
    [[nodiscard]] const CytosolPressureParameters& parameters() const { return parameters_; }
    [[nodiscard]] double K_kPa() const { return parameters_.K_kPa; }
    [[nodiscard]] double T_I_s() const { return parameters_.T_I_s; }
    [[nodiscard]] double T_d_s() const { return parameters_.T_d_s; }
    [[nodiscard]] bool is_exact() const { return parameters_.is_exact; }

  private:
    [[nodiscard]] double pressure_at_target_kPa(const Configuration& at, int cell) const;

    CytosolPressureParameters parameters_;
};

}  // namespace spheroscope
