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
    double speed_ratio = 0.0;  ///< RMS normal speed of the end over the reference's; NaN: not there
};

/// Where a fixed-step explicit method blows up in a scene, beside what the program says itself.
struct StepLadder {
    std::string scene;
    const MethodRow* method = nullptr;
    std::vector<StepTrial> trials;     ///< in the order in which they were made
    double largest_stable_s = 0.0;     ///< NaN: none was found
    double smallest_unstable_s = 0.0;  ///< NaN likewise
    double estimate_s = 0.0;  ///< that the program lets through, the least in the run; NaN: none
    /// It was stopped before its last trial: what it has says nothing of steps not tried.
    bool is_interrupted = false;

    /// NaN where either is missing.
    [[nodiscard]] double estimate_over_stable() const { return estimate_s / largest_stable_s; }
};

/// What the program's estimate may be of the largest step that holds: never more, as a run would
/// blow up unrefused, and not so little that many steps that hold are refused.
inline constexpr double k_least_estimate_over_stable = 0.7;
inline constexpr double k_most_estimate_over_stable = 1.0;
/// False as well where there is no ratio.
[[nodiscard]] bool is_estimate_good(const StepLadder& ladder);

struct StepLadderOptions {
    int threads = 1;
    const std::atomic<bool>* stop = nullptr;
    int n_bisections = 4;
};

/// Raises the step of every explicit method with fixed steps from half the program's estimate to
/// eight times it, in factors of sqrt(2), with the method's own check switched off; then halves the
/// interval n_bisections times. A run is stable if it comes to its end with nodes at most twice as
/// fast as in a run with a quarter of the estimated step (nodes that bounce are several times as
/// fast), and within half of its gamma_eff and 10 % of its contact area. Where nodes end is not
/// asked: cells that creep come to other places with every step. A last stage shorter than 100
/// estimated steps is made as long: bouncing needs time to grow. Where it is stopped, the last
/// ladder is an interrupted one. Throws Error as with_fixed_outputs.
[[nodiscard]] std::vector<StepLadder> climb_steps(const scene::Scene& scene,
                                                  const StepLadderOptions& options);

/// Speed of the end over the step, one panel for each ladder: points that hold, points that do not,
/// and the program's own largest step.
[[nodiscard]] Plot step_ladder_plot(const std::vector<StepLadder>& ladders);

}  // namespace spheroscope::reports
