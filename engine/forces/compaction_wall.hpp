#pragma once

#include "engine/forces/force_term.hpp"

namespace spheroscope {

struct CompactionWallParameters {
    double k_kPa_per_um = 0.0;  ///< pressure per overlap
};

/// A frictionless spherical wall about the origin that keeps the cells inside; the paper compacts
/// its aggregates but prints no law. F_i = -k a_i (|x_i| - R_wall)+ x_i/|x_i| with the node's rest
/// area a_i. Configuration::wall_radius_um = 0 means that no wall stands at present.
class CompactionWall final : public ForceTerm {
  public:
    /// Throws Error unless k > 0.
    CompactionWall(Loc loc, const CompactionWallParameters& parameters);

    [[nodiscard]] std::string_view name() const override { return "stage.compact"; }
    [[nodiscard]] Need needs() const override { return Need::none; }
    void add_force(const Configuration& at, int cell, std::span<Vec3> F_nN) const override;
    [[nodiscard]] std::optional<double> energy_fJ(const Configuration& at, int cell) const override;
    /// The radial part; the rest is smaller by overlap/R_wall.
    void add_stiffness(const Configuration& at, int cell, CellStiffness& K) const override;

    /// Sum of the magnitudes of the forces on this cell; also -dE/dR_wall: a moving wall does the
    /// work -load dR_wall.
    [[nodiscard]] double load_nN(const Configuration& at, int cell) const;

  private:
    CompactionWallParameters parameters_;
};

}  // namespace spheroscope
