#pragma once

namespace spheroscope {

/// How a contact energy becomes forces.
enum class ContactForm {
    traction,     ///< the paper's normal-only force of pairs of triangles (triangle_pair.hpp)
    variational,  ///< F = -dE/dx of the energy on each cell's own surface (variational_search.hpp)
};

/// The adhesive contact law of two surfaces, each moved outward by h0 (Cuvelier et al. 2021, eqns
/// (5) and (6)): at total overlap delta >= 0 the pressure is P = k delta - P0 (> 0 pushes apart)
/// and the energy per area e = k delta^2 / 2 - P0 delta, with its minimum -W at delta_eq = P0 / k.
struct ContactLaw {
    double h0_um = 0.3;         ///< range of the adhesion, per surface
    double P0_kPa = 0.0;        ///< largest tension
    double k_kPa_per_um = 0.0;  ///< stiffness per area
    double reject_cos = 0.0;    ///< traction: no contact of triangles with n_A . n_B >= this
    /// A pair that is deeper than this is two surfaces that passed through each other, not a
    /// contact.
    double largest_overlap_um = 1.6;
    ContactForm form = ContactForm::traction;

    [[nodiscard]] double pressure_kPa(double overlap_um) const {
        return k_kPa_per_um * overlap_um - P0_kPa;
    }
    [[nodiscard]] double energy_fJ_per_um2(double overlap_um) const {
        return (0.5 * k_kPa_per_um * overlap_um - P0_kPa) * overlap_um;
    }
    [[nodiscard]] double work_of_adhesion_nN_per_um() const {
        return 0.5 * P0_kPa * P0_kPa / k_kPa_per_um;
    }
};

/// The law with work of adhesion W and equilibrium overlap delta_eq = equilibrium_overlap_h0 * h0:
/// P0 = 2 W / delta_eq, k = 2 W / delta_eq^2. (2: the real surfaces touch at equilibrium; 1: gap
/// h0.)
[[nodiscard]] inline ContactLaw adhesive_law(double W_nN_per_um, double h0_um,
                                             double equilibrium_overlap_h0, double reject_cos) {
    const double delta_eq_um = equilibrium_overlap_h0 * h0_um;
    return {h0_um, 2.0 * W_nN_per_um / delta_eq_um, 2.0 * W_nN_per_um / (delta_eq_um * delta_eq_um),
            reject_cos, 2.0 * h0_um + 1.0};
}

/// Repulsion only.
[[nodiscard]] inline ContactLaw repulsive_law(double k_kPa_per_um, double h0_um,
                                              double reject_cos) {
    return {h0_um, 0.0, k_kPa_per_um, reject_cos, 2.0 * h0_um + 1.0};
}

}  // namespace spheroscope
