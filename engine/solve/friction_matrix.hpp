#pragma once

#include "engine/friction/contact_friction.hpp"
#include "engine/model/model.hpp"

#include <optional>
#include <vector>

namespace spheroscope {

/// Which frictions a scene has; each one that is absent costs nothing.
struct Frictions {
    double eta_f_kPa_s = 0.0;                ///< medium, eqn (14); always present
    double edge_nN_s_per_um = 0.0;           ///< cortex, eqns (15), (16); 0: absent
    std::optional<ContactFriction> contact;  ///< eqns (17), (18)
};

/// The cheapest shape that the friction matrix can have in a scene.
enum class FrictionShape {
    diagonal,  ///< drag alone: velocities are a division, there is no solver
    fixed,     ///< drag and cortex: one factorisation for the whole run
    changing,  ///< contact friction too: iterative
};
[[nodiscard]] inline FrictionShape shape_of(const Frictions& frictions) {
    if (frictions.contact) return FrictionShape::changing;
    return frictions.edge_nN_s_per_um > 0.0 ? FrictionShape::fixed : FrictionShape::diagonal;
}

/// Drag of every node, nN s/um [all nodes].
[[nodiscard]] std::vector<double> node_drags(const Model& model, double eta_f_kPa_s);

}  // namespace spheroscope
