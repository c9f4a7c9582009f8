#pragma once

#include "engine/forces/force_term.hpp"

#include <vector>

namespace spheroscope {

/// Given forces on all nodes, constant in time: what surroundings that are no longer there did at
/// one moment. Not in the paper.
class HeldForce final : public ForceTerm {
  public:
    /// force_nN [all nodes]. Throws Error unless all are finite.
    HeldForce(Loc loc, std::vector<Vec3> force_nN);

    [[nodiscard]] std::string_view name() const override { return "load.held"; }
    [[nodiscard]] Need needs() const override { return Need::none; }
    void add_force(const Configuration& at, int cell, std::span<Vec3> F_nN) const override;
    /// -F . x, zero at the origin.
    [[nodiscard]] std::optional<double> energy_fJ(const Configuration& at, int cell) const override;

  private:
    std::vector<Vec3> force_nN_;
};

}  // namespace spheroscope
