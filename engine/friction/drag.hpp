#pragma once

#include "engine/model/model.hpp"

#include <span>

namespace spheroscope {

/// Drag of the medium on one node, nN s/um, eqn (14): 3 eta_f / (2 R) times its share of the
/// surface. The share is that of the rest shape, so that a lone cell's friction matrix never
/// changes; summed over a sphere it is Stokes' 6 pi eta_f R (up to the area of the mesh).
[[nodiscard]] inline double node_drag_nN_s_per_um(double eta_f_kPa_s, double radius_um,
                                                  double unit_node_area) {
    return 1.5 * eta_f_kPa_s / radius_um * (radius_um * radius_um * unit_node_area);
}

}  // namespace spheroscope
