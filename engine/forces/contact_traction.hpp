#pragma once

#include "engine/forces/force_term.hpp"

namespace spheroscope {

/// Adhesion and repulsion between cells, eqns (5)-(7), contact law `traction`: the paper's
/// normal-only force. It keeps linear and angular momentum, but it is not the gradient of the
/// contact energy: the tangential tension that the area's derivative would give is left out, as in
/// the paper ('Departures').
class ContactTraction final : public ForceTerm {
  public:
    using ForceTerm::ForceTerm;
    [[nodiscard]] std::string_view name() const override { return "contact"; }
    [[nodiscard]] Need needs() const override { return Need::triangles | Need::contacts; }
    void add_force(const Configuration& at, int cell, std::span<Vec3> F_nN) const override;
    /// Half of each pair's energy; a diagnostic here, since the force is not its gradient.
    [[nodiscard]] std::optional<double> energy_fJ(const Configuration& at, int cell) const override;
    // Its stiffness k S n n^T couples two cells: the contact operator holds it.
};

}  // namespace spheroscope
