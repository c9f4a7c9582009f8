// RKC, the stabilised explicit Runge-Kutta-Chebyshev method of order 2 (Sommeijer, Shampine and
// Verwer, J. Comput. Appl. Math. 88, 1998, 315). With s stages it is stable up to dt rate =
// 0.65 s^2, where s steps of forward Euler reach 2 s: five to ten times further for the same number
// of force evaluations, and no stiffness but for the estimate of the rate (fastest_mode.hpp).
//
// Each stage is f(x) = Gamma(x)^-1 F(x): one evaluation and one friction solve that starts from the
// stage before. The integral of the volume controller is an unknown like the positions. A moving
// wall is taken at the time of the stage.
//
// Error: 0.8 (x_n - x_{n+1}) + 0.4 dt (f_n + f_{n+1}), as the authors give it, of order dt^3.
// f_{n+1} is the first stage of the next step and kept for it, in the system and as the state's
// velocity.

#include "engine/solve/rkc.hpp"

#include "engine/solve/explicit_bound.hpp"
#include "engine/solve/implicit_volume.hpp"
#include "engine/solve/step_common.hpp"
#include "engine/solve/step_size.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace spheroscope {
namespace {

constexpr int k_most_stages = 60;
/// The rate is estimated from below, and it grows between two estimates.
constexpr double k_rate_margin = 1.1;
constexpr double k_damping = 2.0 / 13.0;

/// Coefficients of the stages 1 ... s, in the notation of the paper. Stage 1 is a step of forward
/// Euler: mu, nu and gamma_tilde are zero there.
struct Chebyshev {
    struct Stage {
        double mu, nu, mu_tilde, gamma_tilde, c;
    };
    std::array<Stage, k_most_stages + 1> stages;

    explicit Chebyshev(int s) {
        const double w0 = 1.0 + k_damping / (static_cast<double>(s) * s);
        std::array<double, k_most_stages + 1> T{}, dT{}, ddT{}, b{};
        T[0] = 1.0;
        T[1] = w0;
        dT[1] = 1.0;
        const auto n = static_cast<std::size_t>(s);
        for (std::size_t j = 2; j <= n; ++j) {
            T[j] = 2.0 * w0 * T[j - 1] - T[j - 2];
            dT[j] = 2.0 * w0 * dT[j - 1] - dT[j - 2] + 2.0 * T[j - 1];
            ddT[j] = 2.0 * w0 * ddT[j - 1] - ddT[j - 2] + 4.0 * dT[j - 1];
            b[j] = ddT[j] / (dT[j] * dT[j]);
        }
        b[0] = b[1] = b[2];
        const double w1 = dT[n] / ddT[n];
        const double c2 = w1 * ddT[2] / dT[2];
        stages[1] = {0.0, 0.0, b[1] * w1, 0.0, c2 / dT[2]};
        for (std::size_t j = 2; j <= n; ++j) {
            const double mu_tilde = 2.0 * b[j] * w1 / b[j - 1];
            const double a = 1.0 - b[j - 1] * T[j - 1];
            stages[j] = {2.0 * b[j] * w0 / b[j - 1], -b[j] / b[j - 2], mu_tilde, -a * mu_tilde,
                         w1 * ddT[j] / dT[j]};
        }
    }
};

/// Fewest stages with which dt is stable, at least 2 (there is no RKC of order 2 with one).
int stages_for(double dt_s, double rate_per_s) {
    const double s = 1.0 + std::floor(std::sqrt(1.54 * dt_s * k_rate_margin * rate_per_s + 1.0));
    return s <= k_most_stages ? std::max(2, static_cast<int>(s)) : k_most_stages + 1;
}

/// Positions and integrals, or their rates.
struct Unknowns {
    std::vector<Vec3> x;
    std::vector<double> I;
    void resize(const State& state) {
        x.resize(state.x_um.size());
        I.resize(state.volume_integral_s.size());
    }
};

class Rkc final : public Method {
  public:
    explicit Rkc(const MethodParameters& parameters) : parameters_(parameters) {}

    StepOutcome advance(System& system, State& state, double limit_s,
                        bool freeze_volume_integral) override;

  private:
    /// The rates at the evaluation that the system holds; starts the solver from rates.x. False if
    /// it does not converge.
    bool compute_rates(System& system, Unknowns& rates, StepOutcome& outcome) const;
    /// All stages of a step of outcome.dt_s; the end is y_[2], its rates f_. False if a solve did
    /// not converge or a stage was not finite (then: trouble).
    bool compute_stages(System& system, const State& state, int n_stages, StepOutcome& outcome);

    MethodParameters parameters_;
    ExplicitBound bound_;
    bool integral_moves_ = false;
    Unknowns f0_, f_;            // rates at the start and at the last stage
    std::array<Unknowns, 3> y_;  // two stages before, one before, this one
};

bool Rkc::compute_rates(System& system, Unknowns& rates, StepOutcome& outcome) const {
    const SolveOutcome solve =
        system.solve_friction(system.force_nN(), rates.x, parameters_.linear_tolerance);
    outcome.linear_iterations += solve.iterations;
    if (integral_moves_)
        volume_strains(system, rates.I);
    else
        std::fill(rates.I.begin(), rates.I.end(), 0.0);
    return solve.converged;
}

bool Rkc::compute_stages(System& system, const State& state, int n_stages, StepOutcome& outcome) {
    const Chebyshev chebyshev(n_stages);
    const double dt_s = outcome.dt_s;
    for (Unknowns* y : {&y_[1], &y_[2]}) {
        y->x.assign(state.x_um.begin(), state.x_um.end());
        y->I.assign(state.volume_integral_s.begin(), state.volume_integral_s.end());
    }
    f_.x.assign(f0_.x.begin(), f0_.x.end());
    f_.I.assign(f0_.I.begin(), f0_.I.end());
    for (int j = 1; j <= n_stages; ++j) {
        const Chebyshev::Stage& k = chebyshev.stages[static_cast<std::size_t>(j)];
        std::swap(y_[0], y_[1]);
        std::swap(y_[1], y_[2]);
        const auto combine = [&](const auto& start, const auto& before2, const auto& before,
                                 const auto& rate0, const auto& rate, auto& result) {
            for (std::size_t i = 0; i < result.size(); ++i)
                result[i] = (1.0 - k.mu - k.nu) * start[i] + k.mu * before[i] + k.nu * before2[i] +
                            (k.mu_tilde * dt_s) * rate[i] + (k.gamma_tilde * dt_s) * rate0[i];
        };
        combine(state.x_um, y_[0].x, y_[1].x, f0_.x, f_.x, y_[2].x);
        combine(state.volume_integral_s, y_[0].I, y_[1].I, f0_.I, f_.I, y_[2].I);
        const double time_s = state.time_s + k.c * dt_s;
        const double wall_um = state.wall.acts() ? state.wall.radius_at(time_s) : 0.0;
        outcome.trouble = system.evaluate(y_[2].x, y_[2].I, wall_um);
        if (outcome.trouble || !compute_rates(system, f_, outcome)) return false;
    }
    return true;
}

StepOutcome Rkc::advance(System& system, State& state, double limit_s,
                         bool freeze_volume_integral) {
    StepOutcome outcome;
    const StepSize size(parameters_);
    integral_moves_ = !freeze_volume_integral;
    for (Unknowns* unknowns : {&f0_, &f_, &y_[0], &y_[1], &y_[2]}) unknowns->resize(state);
    const bool estimates = ExplicitBound::is_due(state);
    const double wall_um = state.wall.acts() ? state.wall.radius_at(state.time_s) : 0.0;
    outcome.trouble = system.evaluate(state.x_um, state.volume_integral_s, wall_um);
    if (outcome.trouble) return outcome;
    describe_forces(system, outcome);
    const double rate_per_s = estimates ? bound_.estimate_per_s(system) : state.fastest_rate_per_s;
    f0_.x.assign(state.v_um_per_s.begin(), state.v_um_per_s.end());
    const bool started = compute_rates(system, f0_, outcome);
    describe_powers(system, state, freeze_volume_integral, f0_.x, outcome);

    double wanted_s = size.first_s(state);
    while (true) {
        const double end_s = step_end_s(state.time_s, wanted_s, limit_s);
        const double dt_s = outcome.dt_s = end_s - state.time_s;
        const int n_stages = stages_for(dt_s, rate_per_s);
        bool solved = started && n_stages <= k_most_stages;
        solved = solved && compute_stages(system, state, n_stages, outcome);
        if (outcome.trouble) return outcome;
        if (solved) {
            double largest2 = 0.0;
            for (std::size_t i = 0; i < f0_.x.size(); ++i) {
                const Vec3 moved = y_[2].x[i] - state.x_um[i];
                largest2 = std::max(largest2, moved.squaredNorm());
                y_[0].x[i] = (0.4 * dt_s) * (f0_.x[i] + f_.x[i]) - 0.8 * moved;
            }
            outcome.largest_displacement_um = std::sqrt(largest2);
            outcome.error_um = largest_cell_rms(system.model(), y_[0].x);
        }
        if (!size.is_good(outcome, solved)) {
            wanted_s = size.retry_s(outcome, solved, 3);
            if (outcome.trouble) return outcome;
            continue;
        }
        if (size.is_adaptive()) state.next_dt_s = size.next_s(outcome, wanted_s, 3);
        if (estimates) ExplicitBound::keep(state, rate_per_s);
        std::swap(state.volume_integral_s, y_[2].I);
        finish_step_at(state, y_[2].x, f_.x, end_s);
        outcome.accepted = true;
        return outcome;
    }
}

}  // namespace

std::unique_ptr<Method> make_rkc(const MethodParameters& parameters) {
    return std::make_unique<Rkc>(parameters);
}

}  // namespace spheroscope
