#pragma once

#include "engine/base/vec3.hpp"

#include <span>
#include <vector>

namespace spheroscope {

/// Memory of the 'fast inertial relaxation engine', FIRE (Bitzek et al. 2006, Phys. Rev. Lett. 97,
/// 170201): points of unit mass slide downhill, are turned towards the force as they go, and are
/// stopped as soon as they run uphill. It needs about sqrt(condition number) steps where overdamped
/// motion needs the condition number, and no energy, only forces.
struct FireState {
    std::vector<Vec3> velocity;  ///< [n points]
    double dt = 0.0;
    double mixing = 0.0;  ///< alpha of the paper: weight of the force's direction
    int n_downhill = 0;   ///< steps since the last stop
};

/// At rest, with the first time step. Stable for largest_dt < 2 / (largest angular frequency).
[[nodiscard]] FireState make_fire_state(std::size_t n_points, double largest_dt);

/// One step. force [n]: at x, per unit mass. x [n]: moved on.
void advance_fire(FireState& state, double largest_dt, std::span<const Vec3> force,
                  std::span<Vec3> x);

}  // namespace spheroscope
