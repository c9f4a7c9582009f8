#pragma once

#include "engine/base/workers.hpp"
#include "engine/forces/force_term.hpp"

#include <optional>
#include <span>
#include <vector>

namespace spheroscope {

/// What measures read: one configuration, its velocities, and the parameters that appear in
/// formulas.
struct MeasureInput {
    const Configuration& at;
    std::span<const Vec3> v_um_per_s;          ///< [all nodes]
    std::span<const double> spring_nN_per_um;  ///< [n_edges] k of (8); empty without elasticity
    double gamma_nN_per_um = 0.0;              ///< active tension; 0 without
    std::span<const double> pressure_kPa;      ///< [cells]; empty without cytosol
    std::span<const Mat3> cell_stress_kPa;     ///< [cells]; empty without contacts
    double touching_area_um2 = 0.1;
    double omega_nN_per_um = 0.0;  ///< as the scene reads it; 0: not given
    double W_nN_per_um = 0.0;      ///< work of adhesion; 0: no adhesion
};

/// Stress tensor of every cell from its contact forces, kPa, tension positive, symmetric (Cuvelier
/// et al. 2021, eqn (4) before the trace):
///
///   V_a sigma_a = sum over nodes i of a of F_i (x_i - x_a) + 1/2 sum over pairs of a of Y_AB,
///   Y_AB = - sum over the six nodes of F_i x_i
///
/// Y_AB is the pair's own virial: two surfaces with a gap between them pull over a distance, and
/// each cell gets half of that. Then sum V sigma = 0 holds at rest to the last digit. For one
/// common contact point per pair it is the printed formula.
[[nodiscard]] std::vector<Mat3> cell_stress_tensors(const Configuration& at);
[[nodiscard]] std::vector<Mat3> cell_stress_tensors(const Configuration& at, Workers& workers);

/// The same hydrostatic stress from the inside of the cells, kPa [cells]: what the cells' own terms
/// carry, sigma_h = [ - sum (F_i - F_contact,i).(x_i - x_a) + 1/2 sum Y_AB ] / 3V with the sum F_i
/// of all terms, force_nN [all nodes]. The contacts' part of it is that of the tensors,
/// cell_stress_kPa [cells], so the two differ by the virial of what is not balanced: 0 at rest.
[[nodiscard]] std::vector<double>
hydrostatic_stress_from_inside(const Configuration& at, std::span<const Mat3> cell_stress_kPa,
                               std::span<const Vec3> force_nN);

}  // namespace spheroscope
