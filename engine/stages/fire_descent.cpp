#include "engine/stages/fire_descent.hpp"

#include <algorithm>
#include <cmath>

namespace spheroscope {
namespace {

// The values that Bitzek et al. recommend.
constexpr int k_wait_before_faster = 5;
constexpr double k_dt_growth = 1.1;
constexpr double k_dt_cut = 0.5;
constexpr double k_first_mixing = 0.1;
constexpr double k_mixing_decay = 0.99;
constexpr double k_first_dt_over_largest = 0.1;

}  // namespace

FireState make_fire_state(std::size_t n_points, double largest_dt) {
    return {std::vector<Vec3>(n_points, Vec3::Zero()), k_first_dt_over_largest * largest_dt,
            k_first_mixing, 0};
}

void advance_fire(FireState& state, double largest_dt, std::span<const Vec3> force,
                  std::span<Vec3> x) {
    double power = 0.0, speed_squared = 0.0, force_squared = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        power += force[i].dot(state.velocity[i]);
        speed_squared += state.velocity[i].squaredNorm();
        force_squared += force[i].squaredNorm();
    }
    double keep = 0.0, turn = 0.0;  // v <- keep v + turn F
    if (power > 0.0) {
        keep = 1.0 - state.mixing;
        turn = state.mixing * std::sqrt(speed_squared / force_squared);
        if (++state.n_downhill > k_wait_before_faster) {
            state.dt = std::min(k_dt_growth * state.dt, largest_dt);
            state.mixing *= k_mixing_decay;
        }
    } else if (speed_squared > 0.0) {
        state.n_downhill = 0;
        state.dt *= k_dt_cut;
        state.mixing = k_first_mixing;
    }
    // Semi-implicit Euler: the new velocity moves the point, which keeps oscillations bounded.
    for (std::size_t i = 0; i < x.size(); ++i) {
        state.velocity[i] = keep * state.velocity[i] + (turn + state.dt) * force[i];
        x[i] += state.dt * state.velocity[i];
    }
}

}  // namespace spheroscope
