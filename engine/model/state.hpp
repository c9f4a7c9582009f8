#pragma once

#include "engine/base/vec3.hpp"
#include "engine/model/load.hpp"

#include <cstdint>
#include <vector>

namespace spheroscope {

/// A sphere about the origin that confines the cells; its radius is linear in time between two
/// ends.
struct Wall {
    double radius_um = 0.0;       ///< at time_s; 0: there is no wall
    double speed_um_per_s = 0.0;  ///< > 0 opens
    double time_s = 0.0;
    [[nodiscard]] bool acts() const { return radius_um > 0.0; }
    [[nodiscard]] double radius_at(double t_s) const {
        return radius_um + speed_um_per_s * (t_s - time_s);
    }
    friend bool operator==(const Wall&, const Wall&) = default;
};

/// The only mutable truth of a run: what a method advances. Everything that decides the future is
/// here, and all of it is in a checkpoint.
struct State {
    double time_s = 0.0;
    std::vector<Vec3> x_um;                 ///< [all nodes]
    std::vector<double> volume_integral_s;  ///< [cells] I of (13); an unknown, I' = eps
    Wall wall;
    Load load;
    // What the method carries from step to step: start of the solver, error estimate, step size.
    std::vector<Vec3> v_um_per_s;     ///< [all nodes] of the last accepted step
    bool has_velocity = false;        ///< false at the start and after every change of stage
    double next_dt_s = 0.0;           ///< 0: let the method choose
    double fastest_rate_per_s = 0.0;  ///< of an explicit method: what bounds its stable step
    double rate_time_s = 0.0;         ///< when that was estimated

    /// FNV-1a over the bits of all of it: equal hashes mean equal bits.
    [[nodiscard]] std::uint64_t hash() const;
};

}  // namespace spheroscope
