#include "engine/solve/forward_euler.hpp"

#include "engine/solve/step_common.hpp"

#include <algorithm>
#include <cmath>

namespace spheroscope {
namespace {

std::size_t idx(int i) { return static_cast<std::size_t>(i); }

/// The paper's method: x += dt Gamma^-1 F with a fixed step. Only the derivative part of the volume
/// controller is implicit, as a part of Gamma: explicit, it grows without bound at any step.
class ForwardEuler final : public Method {
  public:
    explicit ForwardEuler(const MethodParameters& parameters) : parameters_(parameters) {}

    StepOutcome advance(System& system, State& state, double limit_s,
                        bool freeze_volume_integral) override;

  private:
    MethodParameters parameters_;
    std::vector<Vec3> v_;
};

StepOutcome ForwardEuler::advance(System& system, State& state, double limit_s,
                                  bool freeze_volume_integral) {
    StepOutcome outcome;
    const Model& model = system.model();
    const double end_s = step_end_s(state.time_s, parameters_.dt_s, limit_s);
    outcome.dt_s = end_s - state.time_s;
    const double wall_um = state.wall.acts() ? state.wall.radius_at(state.time_s) : 0.0;
    outcome.trouble =
        system.evaluate(state.x_um, state.volume_integral_s, wall_um, System::Detail::forces);
    if (outcome.trouble) return outcome;
    describe_forces(system, outcome);

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
    // A node that moves half an edge in one step has left its neighbourhood: the step is too large
    // for the stiffest mode. Going on would bounce the cells apart with finite numbers.
    for (int cell = 0; cell < model.n_cells(); ++cell) {
        const double half_edge_um = 0.5 * model.unit_edge_length[0] * model.radius_um[idx(cell)];
        const std::span<const Vec3> v = model.cell_nodes(std::span<const Vec3>(v_), cell);
        for (std::size_t i = 0; i < v.size(); ++i)
            if (!(outcome.dt_s * v[i].norm() <= half_edge_um)) {
                outcome.trouble =
                    Trouble{"unstable: a node moves more than half an edge in one step"
                            " (a smaller method.dt, or linearly_implicit, would hold)",
                            "", cell, static_cast<int>(i), parameters_.loc};
                return outcome;
            }
    }
    describe_powers(system, state, freeze_volume_integral, v_, outcome);

    if (system.parts().cytosol != nullptr && !freeze_volume_integral) {
        const Configuration at = system.configuration();
        for (int cell = 0; cell < model.n_cells(); ++cell)
            state.volume_integral_s[idx(cell)] +=
                outcome.dt_s * system.parts().cytosol->volume_strain(at, cell);
    }
    finish_step(state, v_, end_s);
    outcome.accepted = true;
    return outcome;
}

}  // namespace

std::unique_ptr<Method> make_forward_euler(const MethodParameters& parameters) {
    return std::make_unique<ForwardEuler>(parameters);
}

}  // namespace spheroscope
