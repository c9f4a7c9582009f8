#pragma once

#include "engine/solve/method.hpp"

namespace spheroscope {

/// Fills the parts of the outcome that describe the forces of the last evaluation.
void describe_forces(System& system, StepOutcome& outcome);

/// Fills dissipation and drive power for the velocities v at the last evaluation.
void describe_powers(System& system, const State& state, bool freeze_volume_integral,
                     std::span<const Vec3> v_um_per_s, StepOutcome& outcome);

/// Largest |v|, um/s.
[[nodiscard]] double largest_speed_um_per_s(std::span<const Vec3> v_um_per_s);

/// RMS over the nodes of a cell of |a - b|, the largest of all cells.
[[nodiscard]] double largest_cell_rms(const Model& model, std::span<const Vec3> a,
                                      std::span<const Vec3> b);

/// RMS over the nodes of a cell of |a|, the largest of all cells.
[[nodiscard]] double largest_cell_rms(const Model& model, std::span<const Vec3> a);

/// dt/2 |v - v_before|, by which a method of order 1 is wrong in one step, um; 0 if the state has
/// no velocity to compare with.
[[nodiscard]] double change_of_velocity_error_um(const Model& model, const State& state,
                                                 std::span<const Vec3> v_um_per_s, double dt_s);

/// Moves the nodes by dt v, and time and wall to end_s. v is exchanged with the state's own.
void finish_step(State& state, std::vector<Vec3>& v_um_per_s, double end_s);

/// The same with the positions at end_s given. Both are exchanged with the state's own.
void finish_step_at(State& state, std::vector<Vec3>& x_um, std::vector<Vec3>& v_um_per_s,
                    double end_s);

/// End of a step that starts at time_s, wants dt_s and must not pass limit_s: lands exactly on the
/// limit, and never leaves a remainder that is too small to be a step.
[[nodiscard]] double step_end_s(double time_s, double dt_s, double limit_s);

}  // namespace spheroscope
