#pragma once

#include "engine/solve/method.hpp"

namespace spheroscope {

/// The size of the next attempt or step of an adaptive method, from what the last attempt gave.
class StepSize {
  public:
    explicit StepSize(const MethodParameters& parameters) : parameters_(parameters) {}

    [[nodiscard]] bool is_adaptive() const { return parameters_.tolerance_um > 0.0; }
    /// The first attempt from this state.
    [[nodiscard]] double first_s(const State& state) const {
        return is_adaptive() && state.next_dt_s > 0.0 ? state.next_dt_s : parameters_.dt_s;
    }
    /// Judges an attempt by its error and its largest displacement. Fixed steps are good whenever
    /// their linear systems were solved.
    [[nodiscard]] bool is_good(const StepOutcome& attempt, bool solved) const;
    /// Size of the step after a good one of attempt.dt_s, of which wanted_s was hoped for.
    /// local_order: the power of dt by which the error estimate grows.
    [[nodiscard]] double next_s(const StepOutcome& attempt, double wanted_s, int local_order) const;
    /// After an attempt that was not good: counts it and returns the next size to try, or, if that
    /// is no choice, 0 and outcome.trouble.
    [[nodiscard]] double retry_s(StepOutcome& outcome, bool solved, int local_order) const;

  private:
    /// How much larger a step may be by the estimate and by the bound, with a margin.
    [[nodiscard]] double factor(const StepOutcome& attempt, int local_order) const;

    const MethodParameters& parameters_;
};

}  // namespace spheroscope
