#pragma once

#include "engine/forces/force_term.hpp"

namespace spheroscope {

struct BodyForceParameters {
    Vec3 force_nN = Vec3::Zero();  ///< on each whole cell
    bool opposed = false;          ///< cell 0 gets +force, cell 1 -force, any other none
};

/// A constant force on each cell, spread over its nodes by rest area. Not in the paper: it drives
/// the scenes that measure drag, and pulls doublets apart.
class BodyForce final : public ForceTerm {
  public:
    /// Throws Error unless the force is finite.
    BodyForce(Loc loc, const BodyForceParameters& parameters);

    [[nodiscard]] std::string_view name() const override { return "body_force"; }
    [[nodiscard]] Need needs() const override { return Need::none; }
    void add_force(const Configuration& at, int cell, std::span<Vec3> F_nN) const override;
    /// -F . x, zero at the origin.
    [[nodiscard]] std::optional<double> energy_fJ(const Configuration& at, int cell) const override;

    /// The whole force on this cell.
    [[nodiscard]] Vec3 on_cell_nN(int cell) const;

  private:
    BodyForceParameters parameters_;
};

}  // namespace spheroscope
