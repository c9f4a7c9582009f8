// ROS2, the two-stage Rosenbrock-W method of Verwer, Spee, Blom and Hundsdorfer (SIAM J. Sci.
// Comput. 20, 1999, 1456), of order 2 with any approximation of the Jacobian:
//
//   (1 - g dt A) k1 = f(x_n, t_n)
//   (1 - g dt A) k2 = f(x_n + dt k1, t_n + dt) - 2 k1        x_{n+1} = x_n + dt (3 k1 + k2)/2
//
// Here f = Gamma(x)^-1 F and A = -Gamma_n^-1 K_n, so both stages are multiplied by the friction
// matrix of the start, Gamma_n. The second right-hand side is then Gamma_n f_2 - 2 Gamma_n k1,
// where Gamma_n f_2 = F_2 + (Gamma_n - Gamma_2) f_2. The difference of the two matrices is O(dt),
// and so is f_2 - k1; with k1 in the place of f_2 the error is O(dt^2) in k2, O(dt^3) in the step,
// and
//
//   (Gamma_n + g dt K_n) k2 = F_2 - (Gamma_n + Gamma_2) k1
//
// is a method of order 2 that needs no solve with Gamma_2, only a product. It is also the more
// robust one: f_2 amplifies what is stiff, k1 has damped it.
//
// The integral of the volume controller is an unknown of both stages (implicit_volume.hpp). A
// moving wall is taken at t_n and t_n + dt, by the stages.
//
// Error: the first stage alone, x_n + dt k1, is a solution of order 1; it differs from the step by
// dt/2 |k1 + k2|. That costs nothing. The estimate is then of order dt^2, one less than the step's
// own error: what is controlled is an upper bound.

#include "engine/solve/rosenbrock_w.hpp"

#include "engine/solve/implicit_volume.hpp"
#include "engine/solve/step_common.hpp"
#include "engine/solve/step_size.hpp"

#include <cmath>
#include <numbers>

namespace spheroscope {
namespace {

constexpr double k_gamma = 1.0 - 0.5 * std::numbers::sqrt2;

class RosenbrockW final : public Method {
  public:
    explicit RosenbrockW(const MethodParameters& parameters) : parameters_(parameters) {}

    StepOutcome advance(System& system, State& state, double limit_s,
                        bool freeze_volume_integral) override;

  private:
    /// Both stages from the evaluation of the start, which the system holds before and after. False
    /// if a linear system was not solved or the second evaluation was not finite (then: trouble).
    bool compute_stages(System& system, const State& state, double end_s, StepOutcome& outcome);

    MethodParameters parameters_;
    ImplicitVolume volume_;
    std::vector<Vec3> k1_, k2_, b_, friction_, x2_;
    std::vector<double> rate1_, rate2_, integral2_s_;  // [cells] of the volume integral
};

bool RosenbrockW::compute_stages(System& system, const State& state, double end_s,
                                 StepOutcome& outcome) {
    const double dt_s = outcome.dt_s;
    const auto solve = [&](std::vector<double>& rate, std::vector<Vec3>& k) {
        volume_.add_pressure(system, rate, b_);
        const SolveOutcome solved = system.solve_implicit(k_gamma * dt_s, volume_.coefficient(), b_,
                                                          k, parameters_.linear_tolerance);
        outcome.linear_iterations += solved.iterations;
        volume_.add_motion(system, k, rate);
        return solved.converged;
    };
    b_.assign(system.force_nN().begin(), system.force_nN().end());
    k1_.assign(state.v_um_per_s.begin(), state.v_um_per_s.end());
    rate1_.resize(state.volume_integral_s.size());
    volume_strains(system, rate1_);
    if (!solve(rate1_, k1_)) return false;
    outcome.largest_displacement_um = dt_s * largest_speed_um_per_s(k1_);
    if (!std::isfinite(outcome.largest_displacement_um)) return false;

    friction_.resize(k1_.size());
    system.friction_product(k1_, friction_);
    x2_.assign(state.x_um.begin(), state.x_um.end());
    for (std::size_t i = 0; i < x2_.size(); ++i) x2_[i] += dt_s * k1_[i];
    integral2_s_.assign(state.volume_integral_s.begin(), state.volume_integral_s.end());
    if (volume_.integral_moves())
        for (std::size_t cell = 0; cell < rate1_.size(); ++cell)
            integral2_s_[cell] += dt_s * rate1_[cell];
    const double wall_um = state.wall.acts() ? state.wall.radius_at(end_s) : 0.0;

    system.exchange_evaluations();
    outcome.trouble = system.evaluate(x2_, integral2_s_, wall_um);
    if (!outcome.trouble) {
        b_.assign(system.force_nN().begin(), system.force_nN().end());
        system.friction_product(k1_, k2_);
        rate2_.resize(rate1_.size());
        volume_strains(system, rate2_);
    }
    system.exchange_evaluations();
    if (outcome.trouble) return false;
    for (std::size_t i = 0; i < b_.size(); ++i) b_[i] -= friction_[i] + k2_[i];
    for (std::size_t cell = 0; cell < rate2_.size(); ++cell) rate2_[cell] -= 2.0 * rate1_[cell];
    for (std::size_t i = 0; i < k2_.size(); ++i) k2_[i] = -k1_[i];  // what k2 is at rest
    return solve(rate2_, k2_);
}

StepOutcome RosenbrockW::advance(System& system, State& state, double limit_s,
                                 bool freeze_volume_integral) {
    StepOutcome outcome;
    const StepSize size(parameters_);
    const double wall_um = state.wall.acts() ? state.wall.radius_at(state.time_s) : 0.0;
    outcome.trouble = system.evaluate(state.x_um, state.volume_integral_s, wall_um);
    if (outcome.trouble) return outcome;
    describe_forces(system, outcome);
    k2_.resize(state.x_um.size());
    double wanted_s = size.first_s(state);
    while (true) {
        const double end_s = step_end_s(state.time_s, wanted_s, limit_s);
        const double dt_s = outcome.dt_s = end_s - state.time_s;
        volume_.set_up(system, k_gamma * dt_s, freeze_volume_integral);
        const bool solved = compute_stages(system, state, end_s, outcome);
        if (outcome.trouble) return outcome;
        if (solved) {
            // k1 becomes the velocity of the step, k2 its difference to the first stage.
            for (std::size_t i = 0; i < k1_.size(); ++i) {
                const Vec3 difference = 0.5 * (k1_[i] + k2_[i]);
                k1_[i] += difference;
                k2_[i] = difference;
            }
            outcome.error_um = dt_s * largest_cell_rms(system.model(), k2_);
            outcome.largest_displacement_um = dt_s * largest_speed_um_per_s(k1_);
        }
        if (!size.is_good(outcome, solved)) {
            wanted_s = size.retry_s(outcome, solved, 2);
            if (outcome.trouble) return outcome;
            continue;
        }
        describe_powers(system, state, freeze_volume_integral, k1_, outcome);
        if (size.is_adaptive()) state.next_dt_s = size.next_s(outcome, wanted_s, 2);
        if (volume_.integral_moves())
            for (std::size_t cell = 0; cell < rate1_.size(); ++cell)
                state.volume_integral_s[cell] += dt_s * (1.5 * rate1_[cell] + 0.5 * rate2_[cell]);
        finish_step(state, k1_, end_s);
        outcome.accepted = true;
        return outcome;
    }
}

}  // namespace

std::unique_ptr<Method> make_rosenbrock_w(const MethodParameters& parameters) {
    return std::make_unique<RosenbrockW>(parameters);
}

}  // namespace spheroscope
