#pragma once

#include "engine/forces/force_term.hpp"

namespace spheroscope {

/// Adhesion and repulsion between cells, contact law `variational`: F = -dE/dx of the energy that
/// contact/variational_search.hpp describes. The part through the overlap acts on pairs, as in
/// `traction`; the part through the areas is a tension of each touching triangle, which the paper's
/// force leaves out.
class ContactVariational final : public ForceTerm {
  public:
    using ForceTerm::ForceTerm;
    [[nodiscard]] std::string_view name() const override { return "contact"; }
    /// volumes: on which side of an edge or a node a point lies is told by dV/dx.
    [[nodiscard]] Need needs() const override {
        return Need::triangles | Need::volumes | Need::contacts;
    }
    void add_force(const Configuration& at, int cell, std::span<Vec3> F_nN) const override;
    /// What is stored on this cell's own surface: half of the energy of its contacts, up to the
    /// difference of the two sides.
    [[nodiscard]] std::optional<double> energy_fJ(const Configuration& at, int cell) const override;
    // The stiffness k S n n^T of the pairs is the contact operator's. The films have none: their
    // tension is negative, and a stiffness has to be positive semi-definite.
};

/// Force of one film on the corners of its triangle, nN.
[[nodiscard]] std::array<Vec3, 3> film_forces_nN(const Configuration& at, int cell,
                                                 const ContactFilm& film);

}  // namespace spheroscope
