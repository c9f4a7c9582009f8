#pragma once

#include "engine/forces/force_term.hpp"

namespace spheroscope {

struct ConfiningHullParameters {
    double k_kPa_per_um = 0.0;  ///< pressure per overlap
};

/// A convex hull that confines without friction and without adhesion (Cuvelier et al. 2021,
/// Appendix G, which prints no law). F_i = -k a_i (x_i - y_i) with the node's rest area a_i and the
/// point y_i of the hull that is nearest to it. The nodes that made the hull sit in its corners: a
/// force along the normal of the farthest plane alone would jump there from plane to plane, and the
/// cells would never come to rest.
class ConfiningHull final : public ForceTerm {
  public:
    /// Throws Error unless k > 0.
    ConfiningHull(Loc loc, const ConfiningHullParameters& parameters);

    [[nodiscard]] std::string_view name() const override { return "stage.indent.hull"; }
    [[nodiscard]] Need needs() const override { return Need::none; }
    void add_force(const Configuration& at, int cell, std::span<Vec3> F_nN) const override;
    [[nodiscard]] std::optional<double> energy_fJ(const Configuration& at, int cell) const override;
    void add_stiffness(const Configuration& at, int cell, CellStiffness& K) const override;

    /// Sum of the forces on all cells, nN.
    [[nodiscard]] Vec3 sum_nN(const Configuration& at) const;

  private:
    ConfiningHullParameters parameters_;
};

}  // namespace spheroscope
