#include "engine/solve/step_size.hpp"

#include <algorithm>
#include <cmath>

namespace spheroscope {
namespace {

/// Steps are aimed a little below their bounds: a rejected one costs more than it would have won.
constexpr double k_margin = 0.85;

}  // namespace

bool StepSize::is_good(const StepOutcome& attempt, bool solved) const {
    if (!solved || !is_adaptive()) return solved;
    return attempt.error_um <= parameters_.tolerance_um &&
           attempt.largest_displacement_um <= parameters_.displacement_bound_um;
}

double StepSize::factor(const StepOutcome& attempt, int local_order) const {
    if (!std::isfinite(attempt.largest_displacement_um)) return 0.1;
    double factor = 2.0;
    if (attempt.error_um > 0.0)
        factor = std::min(factor, k_margin * std::pow(parameters_.tolerance_um / attempt.error_um,
                                                      1.0 / local_order));
    if (attempt.largest_displacement_um > 0.0)
        factor = std::min(factor, k_margin * parameters_.displacement_bound_um /
                                      attempt.largest_displacement_um);
    return factor;
}

double StepSize::next_s(const StepOutcome& attempt, double wanted_s, int local_order) const {
    const double growth = factor(attempt, local_order);
    // A step that was cut short by the limit says nothing against the size that was wanted.
    const double next_s =
        std::max(attempt.dt_s * growth, attempt.dt_s < wanted_s && growth >= 1.0 ? wanted_s : 0.0);
    return std::min(next_s, parameters_.dt_max_s);
}

double StepSize::retry_s(StepOutcome& outcome, bool solved, int local_order) const {
    ++outcome.rejected;
    const double shrink = solved ? factor(outcome, local_order) : 0.5;
    const double wanted_s = outcome.dt_s * std::clamp(shrink, 0.1, 0.7);
    if (is_adaptive() && wanted_s >= parameters_.dt_min_s) return wanted_s;
    outcome.trouble = Trouble{!solved ? "the linear system of a step could not be solved"
                                      : "the step size fell below method.dt_min",
                              "", -1, -1, parameters_.loc};
    return 0.0;
}

}  // namespace spheroscope
