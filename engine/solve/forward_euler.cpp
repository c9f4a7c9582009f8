// The paper's method: x += dt Gamma^-1 F with a fixed step. Only the derivative part of the volume
// controller is implicit, as a part of Gamma: explicit, it grows without bound at any step.
//
// It is stable up to dt = 2/rate, rate the fastest decay of the linearised motion
// (fastest_mode.hpp). Above, the nodes of a contact do not diverge: they bounce the cells apart,
// with finite numbers and no contact left to see. So the rate is estimated now and then, and a step
// that is too large ends the run, or is made smaller, as method.stable_step says.

#include "engine/solve/forward_euler.hpp"

#include "engine/base/index.hpp"
#include "engine/solve/explicit_bound.hpp"
#include "engine/solve/implicit_volume.hpp"
#include "engine/solve/step_common.hpp"

#include <algorithm>
#include <cmath>

namespace spheroscope {
namespace {

/// Of the step that follows the estimate: the fastest mode still falls by half in every step, and
/// the rate may grow by a quarter before it is estimated again.
constexpr double k_followed_dt_times_rate = 0.8 * 2.0;

class ForwardEuler final : public Method {
  public:
    explicit ForwardEuler(const MethodParameters& parameters) : parameters_(parameters) {}

    StepOutcome advance(System& system, State& state, double limit_s,
                        bool freeze_volume_integral) override;

  private:
    /// A node that moves half an edge in one step has left its neighbourhood.
    [[nodiscard]] std::optional<Trouble> find_jump(const Model& model, double dt_s) const;

    MethodParameters parameters_;
    ExplicitBound bound_;
    std::vector<Vec3> v_;
    std::vector<double> strain_;
};

std::optional<Trouble> ForwardEuler::find_jump(const Model& model, double dt_s) const {
    for (int cell = 0; cell < model.n_cells(); ++cell) {
        const double half_edge_um = 0.5 * model.unit_edge_length[0] * model.radius_um[idx(cell)];
        const std::span<const Vec3> v = model.cell_nodes(std::span<const Vec3>(v_), cell);
        for (std::size_t i = 0; i < v.size(); ++i)
            if (!(dt_s * v[i].norm() <= half_edge_um))
                return Trouble{"unstable: a node moves more than half an edge in one step"
                               " (a smaller method.dt, or linearly_implicit, would hold)",
                               "", cell, static_cast<int>(i), parameters_.loc};
    }
    return {};
}

StepOutcome ForwardEuler::advance(System& system, State& state, double limit_s,
                                  bool freeze_volume_integral) {
    StepOutcome outcome;
    const Model& model = system.model();
    const bool follows = parameters_.stable_step == StableStep::follow;
    const bool estimates =
        parameters_.stable_step != StableStep::ignore && ExplicitBound::is_due(state);
    const double wall_um = state.wall.acts() ? state.wall.radius_at(state.time_s) : 0.0;
    outcome.trouble = system.evaluate(state.x_um, state.volume_integral_s, wall_um);
    if (outcome.trouble) return outcome;
    describe_forces(system, outcome);

    const double rate_per_s = estimates ? bound_.estimate_per_s(system) : state.fastest_rate_per_s;
    const double wanted_s =
        follows ? std::min(k_followed_dt_times_rate / rate_per_s, parameters_.dt_max_s)
                : parameters_.dt_s;
    const double end_s = step_end_s(state.time_s, wanted_s, limit_s);
    outcome.dt_s = end_s - state.time_s;
    constexpr double most = ExplicitBound::k_largest_dt_times_rate;
    if (estimates && !(outcome.dt_s * rate_per_s <= most)) {
        outcome.trouble =
            bound_.too_large(system, outcome.dt_s, most / rate_per_s, parameters_.loc);
        return outcome;
    }

    v_.assign(state.v_um_per_s.begin(), state.v_um_per_s.end());
    const SolveOutcome solve =
        system.solve_friction(system.force_nN(), v_, parameters_.linear_tolerance);
    outcome.linear_iterations = solve.iterations;
    if (!solve.converged) {
        outcome.trouble =
            Trouble{"the friction matrix could not be solved", "", -1, -1, parameters_.loc};
        return outcome;
    }
    outcome.largest_displacement_um = outcome.dt_s * largest_speed_um_per_s(v_);
    outcome.error_um = change_of_velocity_error_um(model, state, v_, outcome.dt_s);
    outcome.trouble = find_jump(model, outcome.dt_s);
    if (outcome.trouble) return outcome;
    describe_powers(system, state, freeze_volume_integral, v_, outcome);

    if (!freeze_volume_integral) {
        strain_.resize(state.volume_integral_s.size());
        volume_strains(system, strain_);
        for (std::size_t cell = 0; cell < strain_.size(); ++cell)
            state.volume_integral_s[cell] += outcome.dt_s * strain_[cell];
    }
    if (estimates) ExplicitBound::keep(state, rate_per_s);
    finish_step(state, v_, end_s);
    outcome.accepted = true;
    return outcome;
}

}  // namespace

std::unique_ptr<Method> make_forward_euler(const MethodParameters& parameters) {
    return std::make_unique<ForwardEuler>(parameters);
}

}  // namespace spheroscope
