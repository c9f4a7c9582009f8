#pragma once

#include "engine/reports/measured_run.hpp"
#include "engine/reports/plot.hpp"
#include "engine/solve/method.hpp"

#include <string>
#include <vector>

namespace spheroscope::reports {

/// One step size of a fixed-step method: did the run hold?
struct StepTrial {
    double dt_s = 0.0;
    bool is_stable = false;
    std::string why;           ///< not stable: the message, or the measure that went wrong
    double shape_error = 0.0;  ///< of the end, RMS of positions over h0; NaN: it did not get there
};

/// Where a fixed-step explicit method blows up in a scene, beside what the program says itself.
struct StepLadder {
    std::string scene;
    const MethodRow* method = nullptr;
    std::vector<StepTrial> trials;     ///< in the order in which they were made
    double largest_stable_s = 0.0;     ///< NaN: none was found
    double smallest_unstable_s = 0.0;  ///< NaN likewise
    double estimate_s = 0.0;           ///< 2 / fastest rate, the smallest during the run; NaN: none
};

struct StepLadderOptions {
    int threads = 1;
    const std::atomic<bool>* stop = nullptr;
    int n_bisections = 4;
};

/// Raises the step of every explicit method with fixed steps from half the program's estimate to
/// eight times it, in factors of sqrt(2), with the method's own check switched off; then halves the
/// interval n_bisections times. A run is stable if it comes to its end within 10 % of h0 (shape),
/// half of gamma_eff and 10 % of the contact area of a run with a quarter of the estimated step.
/// Throws Error as with_fixed_outputs.
[[nodiscard]] std::vector<StepLadder> climb_steps(const scene::Scene& scene,
                                                  const StepLadderOptions& options);

/// Error of the end over the step, one panel for each ladder: points that hold, points that do not,
/// and the program's own largest step.
[[nodiscard]] Plot step_ladder_plot(const std::vector<StepLadder>& ladders);

}  // namespace spheroscope::reports
