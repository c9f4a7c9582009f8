// Linearly implicit (semi-implicit) Euler: (Gamma + dt K) v = F(x_n), x_{n+1} = x_n + dt v, with K
// >= 0 an approximation of -dF/dx. First order, stable for any step: one force evaluation, one
// stiffness and one solve take the place of the tens of small steps that the stiffest spring or
// contact would dictate.
//
// Volume: P at the end of the step is P_n - [K dt + K dt^2/T_I + K T_d] S.v/V* - (K/T_I) dt eps_n,
// from eps_{n+1} = eps_n + dt S.v/V* and I_{n+1} = I_n + dt eps_{n+1}. So the integral of (13) is
// an unknown of the same implicit step, and all of it is one rank-one matrix per cell.
//
// Step size: the local error is estimated by dt/2 |v_{n+1} - v_n| (v_n: velocity of the step
// before), RMS over the nodes of a cell, the largest cell; and no node moves more than the
// displacement bound, because the contacts of a step are those of its start.

#include "engine/solve/linearly_implicit.hpp"

#include "engine/solve/step_common.hpp"
#include "engine/solve/step_size.hpp"

#include <algorithm>
#include <cmath>

namespace spheroscope {

StepOutcome LinearlyImplicit::advance(System& system, State& state, double limit_s,
                                      bool freeze_volume_integral) {
    StepOutcome outcome;
    const StepSize size(parameters_);
    double wanted_s = size.first_s(state);
    bool must_evaluate = true;
    while (true) {
        const double end_s = step_end_s(state.time_s, wanted_s, limit_s);
        const double dt_s = outcome.dt_s = end_s - state.time_s;
        if (must_evaluate) {
            // A moving wall is taken at the end of the step, like everything stiff.
            const double wall_um = state.wall.acts() ? state.wall.radius_at(end_s) : 0.0;
            outcome.trouble =
                system.evaluate(state.x_um, state.volume_integral_s, wall_um, state.load);
            if (outcome.trouble) return outcome;
            describe_forces(system, outcome);
            must_evaluate = state.wall.acts();  // another dt means another wall
        }
        volume_.set_up(system, dt_s, freeze_volume_integral);
        b_.assign(system.force_nN().begin(), system.force_nN().end());
        integral_rate_.resize(state.volume_integral_s.size());
        volume_strains(system, integral_rate_);
        volume_.add_pressure(system, integral_rate_, b_);
        v_.assign(state.v_um_per_s.begin(), state.v_um_per_s.end());
        const SolveOutcome solve = probe_.solve(system, state, dt_s, volume_.coefficient(), b_, v_,
                                                parameters_.linear_tolerance);
        outcome.linear_iterations += solve.iterations;
        outcome.largest_displacement_um =
            dt_s * std::max(largest_speed_um_per_s(v_), std::abs(probe_.speed_um_per_s()));
        outcome.error_um = std::max(change_of_velocity_error_um(system.model(), state, v_, dt_s),
                                    probe_.error_um(state, dt_s));
        if (!size.is_good(outcome, solve.converged)) {
            wanted_s = size.retry_s(outcome, solve.converged, 2);
            if (outcome.trouble) return outcome;
            continue;
        }
        describe_powers(system, state, freeze_volume_integral, v_, outcome);
        outcome.drive_power_nN_um_per_s += probe_.power_nN_um_per_s();
        if (size.is_adaptive())
            state.next_dt_s =
                std::min(size.next_s(outcome, wanted_s, 2), longest_next_step_s(system, outcome));
        if (volume_.integral_moves()) {
            volume_.add_motion(system, v_, integral_rate_);
            for (std::size_t cell = 0; cell < integral_rate_.size(); ++cell)
                state.volume_integral_s[cell] +=
                    volume_.integral_step_s(dt_s) * integral_rate_[cell];
        }
        probe_.finish_step(state, dt_s);
        finish_step(state, v_, end_s);
        outcome.accepted = true;
        return outcome;
    }
}

std::unique_ptr<Method> make_linearly_implicit(const MethodParameters& parameters) {
    return std::make_unique<LinearlyImplicit>(parameters);
}

}  // namespace spheroscope
