#include "engine/forces/terms.hpp"

#include <array>

namespace spheroscope {
namespace {

constexpr std::array<ForceTermRow, 11> k_terms{{
    {"cortex.elastic", "(8)", "engine/forces/in_plane_elasticity.cpp",
     "springs on the edges resist stretch and shear", true, true, true},
    {"cortex.bending", "(9), (10)", "engine/forces/bending.cpp",
     "hinges resist a change of angle between triangles", true, true, true},
    {"cortex.tension", "(11)", "engine/forces/active_tension.cpp",
     "the cortex contracts with a constant tension", true, false, true},
    {"cytosol", "(12), (13)", "engine/forces/cytosol_pressure.cpp",
     "pressure balances the tension and keeps the volume", true, false, false},
    {"cortex.regularisation.strain_limiter", "", "engine/forces/strain_limiter.cpp",
     "soft triangles cannot collapse", true, true, true},
    {"cortex.regularisation.fold_stop", "", "engine/forces/fold_stop.cpp",
     "soft cortices cannot fold over", true, true, true},
    {"stage.compact", "", "engine/forces/compaction_wall.cpp",
     "a spherical wall pushes the cells together", false, false, false},
    {"stage.indent.hull", "Appendix G", "engine/forces/confining_hull.cpp",
     "a convex hull confines the cells", false, false, true},
    {"stage.indent.probe", "Appendix G", "engine/forces/indenting_probe.cpp",
     "a stiff bead is pressed into the cells", false, false, false},
    {"body_force", "", "engine/forces/body_force.cpp", "a constant force on whole cells", false,
     false, true},
    {"load.held", "", "engine/forces/held_force.cpp",
     "what surroundings that are gone did at one moment", false, false, true},
}};

}  // namespace

std::span<const ForceTermRow> force_terms() { return k_terms; }

}  // namespace spheroscope
