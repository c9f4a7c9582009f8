#pragma once

#include "engine/solve/fastest_mode.hpp"
#include "engine/solve/method.hpp"

namespace spheroscope {

/// The fastest rate of the motion as an explicit method uses it: estimated at the start, after
/// every change of stage, and whenever the last estimate is k_age_s old.
class ExplicitBound {
  public:
    /// Contacts spread and cells flatten in about a second.
    static constexpr double k_age_s = 0.2;
    /// Of a step that is let through. A mode with the rate r is stable up to dt r = 2, and the rate
    /// is estimated from below, to one or two percent.
    static constexpr double k_largest_dt_times_rate = 0.95 * 2.0;

    /// Whether the estimate of this state is too old; then evaluate with its stiffness and
    /// estimate.
    [[nodiscard]] static bool is_due(const State& state) {
        return state.fastest_rate_per_s == 0.0 || !state.has_velocity ||
               !(state.time_s - state.rate_time_s < k_age_s);
    }
    /// The rate at the evaluation that the system holds, which has its stiffness.
    [[nodiscard]] double estimate_per_s(System& system) { return mode_.rate_per_s(system); }
    /// For the steps until the next estimate.
    static void keep(State& state, double rate_per_s) {
        state.fastest_rate_per_s = rate_per_s;
        state.rate_time_s = state.time_s;
    }
    /// A step of the paper's method that is too large: names what makes it so.
    [[nodiscard]] Trouble too_large(System& system, double dt_s, double stable_dt_s,
                                    const Loc& loc);

  private:
    FastestMode mode_;
};

}  // namespace spheroscope
