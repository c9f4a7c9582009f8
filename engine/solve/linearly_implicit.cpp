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

#include <algorithm>
#include <cmath>

namespace spheroscope {
namespace {

std::size_t idx(int i) { return static_cast<std::size_t>(i); }

class LinearlyImplicit final : public Method {
  public:
    explicit LinearlyImplicit(const MethodParameters& parameters) : parameters_(parameters) {}

    StepOutcome advance(System& system, State& state, double limit_s,
                        bool freeze_volume_integral) override;

  private:
    /// b = F and the coefficients of S S^T for a step of dt.
    void set_up(System& system, double dt_s, bool freeze_volume_integral);

    MethodParameters parameters_;
    std::vector<Vec3> v_, b_;
    std::vector<double> volume_coefficient_;
};

void LinearlyImplicit::set_up(System& system, double dt_s, bool freeze_volume_integral) {
    b_.assign(system.force_nN().begin(), system.force_nN().end());
    const CytosolPressure* cytosol = system.parts().cytosol;
    if (cytosol == nullptr) return;
    const Model& model = system.model();
    volume_coefficient_.resize(model.radius_um.size());
    const double K = cytosol->K_kPa();
    const double integral_rate = freeze_volume_integral ? 0.0 : K / cytosol->T_I_s();
    const Configuration at = system.configuration();
    for (int cell = 0; cell < model.n_cells(); ++cell) {
        volume_coefficient_[idx(cell)] =
            (K * dt_s + integral_rate * dt_s * dt_s + K * cytosol->T_d_s()) /
            model.target_volume_um3[idx(cell)];
        if (integral_rate == 0.0) continue;
        const double pressure_kPa = -integral_rate * dt_s * cytosol->volume_strain(at, cell);
        const std::span<const Vec3> S =
            model.cell_nodes(std::span<const Vec3>(system.geometry().volume_gradient_um2), cell);
        const std::span<Vec3> b = model.cell_nodes(std::span<Vec3>(b_), cell);
        for (std::size_t i = 0; i < b.size(); ++i) b[i] += pressure_kPa * S[i];
    }
}

StepOutcome LinearlyImplicit::advance(System& system, State& state, double limit_s,
                                      bool freeze_volume_integral) {
    StepOutcome outcome;
    const Model& model = system.model();
    const MethodParameters& p = parameters_;
    const bool adaptive = p.tolerance_um > 0.0;
    double wanted_s = adaptive && state.next_dt_s > 0.0 ? state.next_dt_s : p.dt_s;
    bool must_evaluate = true;
    while (true) {
        const double end_s = step_end_s(state.time_s, wanted_s, limit_s);
        const double dt_s = end_s - state.time_s;
        outcome.dt_s = dt_s;
        if (must_evaluate) {
            // A moving wall is taken at the end of the step, like everything stiff.
            const double wall_um = state.wall.acts() ? state.wall.radius_at(end_s) : 0.0;
            outcome.trouble = system.evaluate(state.x_um, state.volume_integral_s, wall_um,
                                              System::Detail::forces_and_stiffness);
            if (outcome.trouble) return outcome;
            describe_forces(system, outcome);
            must_evaluate = state.wall.acts();  // another dt means another wall
        }
        set_up(system, dt_s, freeze_volume_integral);
        v_.assign(state.v_um_per_s.begin(), state.v_um_per_s.end());
        const SolveOutcome solve =
            system.solve_implicit(dt_s, volume_coefficient_, b_, v_, p.linear_tolerance);
        outcome.linear_iterations += solve.iterations;

        outcome.largest_displacement_um = dt_s * largest_speed_um_per_s(v_);
        outcome.error_um =
            state.has_velocity ? 0.5 * dt_s * largest_cell_rms(model, v_, state.v_um_per_s) : 0.0;
        // How much larger the step may be, from the error (order 2 locally) and from the bound.
        double factor = 2.0;
        bool good = solve.converged;
        if (!solve.converged)
            factor = 0.5;
        else if (adaptive) {
            if (outcome.error_um > 0.0)
                factor = std::min(factor, 0.85 * std::sqrt(p.tolerance_um / outcome.error_um));
            if (outcome.largest_displacement_um > 0.0)
                factor = std::min(factor,
                                  0.85 * p.displacement_bound_um / outcome.largest_displacement_um);
            good = outcome.error_um <= p.tolerance_um &&
                   outcome.largest_displacement_um <= p.displacement_bound_um;
            if (!std::isfinite(outcome.largest_displacement_um)) factor = 0.1;
        }
        if (good) {
            describe_powers(system, state, freeze_volume_integral, v_, outcome);
            if (adaptive) {
                // A step that was cut short by the limit says nothing against the size that was
                // wanted.
                const double base_s =
                    std::max(dt_s * factor, dt_s < wanted_s && factor >= 1.0 ? wanted_s : 0.0);
                state.next_dt_s = std::min(base_s, p.dt_max_s);
            }
            if (!volume_coefficient_.empty() && !freeze_volume_integral) {
                const Configuration at = system.configuration();
                for (int cell = 0; cell < model.n_cells(); ++cell) {
                    const std::span<const Vec3> S = model.cell_nodes(
                        std::span<const Vec3>(system.geometry().volume_gradient_um2), cell);
                    const std::span<const Vec3> v =
                        model.cell_nodes(std::span<const Vec3>(v_), cell);
                    double volume_rate = 0.0;
                    for (std::size_t i = 0; i < v.size(); ++i) volume_rate += S[i].dot(v[i]);
                    state.volume_integral_s[idx(cell)] +=
                        dt_s * (system.parts().cytosol->volume_strain(at, cell) +
                                dt_s * volume_rate / model.target_volume_um3[idx(cell)]);
                }
            }
            for (std::size_t i = 0; i < v_.size(); ++i) state.x_um[i] += dt_s * v_[i];
            std::swap(state.v_um_per_s, v_);
            state.has_velocity = true;
            if (state.wall.acts()) {
                state.wall.radius_um = state.wall.radius_at(end_s);
                state.wall.time_s = end_s;
            }
            state.time_s = end_s;
            outcome.accepted = true;
            return outcome;
        }
        ++outcome.rejected;
        wanted_s = dt_s * std::clamp(factor, 0.1, 0.7);
        if (!adaptive || wanted_s < p.dt_min_s) {
            outcome.trouble =
                Trouble{!solve.converged ? "the linear system of a step could not be solved"
                                         : "the step size fell below method.dt_min",
                        "", -1, -1, p.loc};
            return outcome;
        }
    }
}

}  // namespace

std::unique_ptr<Method> make_linearly_implicit(const MethodParameters& parameters) {
    return std::make_unique<LinearlyImplicit>(parameters);
}

}  // namespace spheroscope
