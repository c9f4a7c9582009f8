#pragma once

#include "engine/forces/force_term.hpp"

#include <vector>

namespace spheroscope {

struct IndentingProbeParameters {
    double k_kPa_per_um = 0.0;       ///< pressure per overlap
    double hertz_modulus_kPa = 0.0;  ///< E* of Hertz's law; 0: the linear one
};

/// A rigid bead that is pressed into the aggregate, with slip and without adhesion: on each node
/// that it touches F_i = p_i a_i along x_i - c, with the node's rest area a_i. Cuvelier et al.
/// 2021, Appendix G, have Hertz contacts of triangles, whose radii and moduli they do not print.
/// Here
///
///   linear   p_i = k d_i, as that of the hull, with the overlap d_i = (R - |x_i - c|)+
///   Hertz    per cell F = 4/3 E* sqrt(R_eff) d^1.5, 1/R_eff = 1/R + 1/R_cell, as p_i = k(d) d_i
///            with k = 4 E* / (3 pi sqrt(R_eff d)). The depth d follows from the overlaps: the sum
///            of a_i d_i^2 / 2 is pi R_eff d^3 / 3 for two spheres, so that the law has the energy
///            8/15 E* sqrt(R_eff) d^2.5 of all nodes. (The same force spread evenly over the
///            touched area jumps whenever a node begins to touch, and never comes to rest.)
class IndentingProbe final : public ForceTerm {
  public:
    /// One node that the probe touches.
    struct Touch {
        std::size_t node;    ///< of all nodes
        double k_nN_per_um;  ///< how the force grows with the overlap
        double force_nN;
        Vec3 outward;  ///< unit, from the probe's centre
        double along;  ///< outward . direction
    };

    /// Throws Error unless k > 0.
    IndentingProbe(Loc loc, const IndentingProbeParameters& parameters);

    [[nodiscard]] std::string_view name() const override { return "stage.indent.probe"; }
    [[nodiscard]] Need needs() const override { return Need::none; }
    void add_force(const Configuration& at, int cell, std::span<Vec3> F_nN) const override;
    [[nodiscard]] std::optional<double> energy_fJ(const Configuration& at, int cell) const override;
    /// For a probe that stands still, along the radius; how it gives way is ProbeCoupling's.
    void add_stiffness(const Configuration& at, int cell, CellStiffness& K) const override;

    /// Replaces `touches` by all that there are, in the order of the nodes.
    void find_touches(const Configuration& at, std::vector<Touch>& touches) const;
    /// Sum of the forces on all cells, nN; what pushes the probe back is its opposite.
    [[nodiscard]] Vec3 sum_nN(const Configuration& at) const;

  private:
    IndentingProbeParameters parameters_;
};

}  // namespace spheroscope
