#pragma once

#include "engine/reports/measured_run.hpp"
#include "engine/reports/plot.hpp"
#include "engine/run/expectations.hpp"
#include "engine/solve/method.hpp"

#include <functional>
#include <string>
#include <vector>

namespace spheroscope::reports {

/// One scene, or one of its variants, with one method: what was expected and what happened.
struct StabilityRow {
    std::string scene;    ///< file name without folder and ending
    std::string variant;  ///< "" for the scene itself
    const MethodRow* method = nullptr;
    std::string expectation;  ///< in words
    bool was_run = false;     ///< false: the time limit or a signal came first
    bool is_refused = false;  ///< the scene, or the engine, refused to begin; run.message says why
    MeasuredRun run;          ///< without its samples
    /// Of [expect]; only if the run came to its end. n_flipped_triangles is the most after any
    /// step.
    std::vector<Expectation> measures;
    double largest_step_h0 = 0.0;       ///< NaN unless a bound is asked for
    double force_change = 0.0;          ///< likewise
    double pull_off_over_W = 0.0;       ///< likewise
    std::string law;                    ///< of contact; "" without contacts
    std::vector<std::string> failures;  ///< what was not as expected, one line each
    // What a plot of the scene's variants is over: the first key that a variant sets.
    std::string varied_key, varied_unit;
    double varied_value = 0.0;  ///< NaN: not a number

    [[nodiscard]] bool met() const { return was_run && failures.empty(); }
    /// "ended", "stopped", "refused", "not run"
    [[nodiscard]] std::string outcome() const;
};

struct StabilityOptions {
    int threads = 1;
    double wall_limit_s = 0.0;  ///< of everything together; 0: none
    const std::atomic<bool>* stop = nullptr;
    std::function<void(const std::string& what, double share)> progress{};  ///< may be empty
};

/// What the scene expects of a method: the table of its name, else of its class (`explicit`:
/// explicit with fixed steps; `implicit`), else `all`; nullptr if there is none of them.
[[nodiscard]] const scene::Stability* stability_rule(const scene::Scene& scene,
                                                     const MethodRow& method);

/// Runs every scene, or all of its variants, with every method of the table; where
/// flipped triangles are asked for, they are counted after every step. Throws Error if a scene
/// itself (without a variant) does not load, has no rule for a method, or names unknown methods.
[[nodiscard]] std::vector<StabilityRow>
check_stability(const std::vector<std::string>& files,
                const std::vector<scene::Override>& overrides, const StabilityOptions& options);

/// [expect] against a run. A triangle that flips and comes back was flipped all the same: of
/// n_flipped_triangles the most after any step counts.
[[nodiscard]] std::vector<Expectation> check_expectations(const scene::Scene& scene,
                                                          const MeasuredRun& run);

/// Mean accepted step of every run that was as expected, over the key that the variants change: one
/// panel for each scene of three variants or more.
[[nodiscard]] Plot stability_plot(const std::vector<StabilityRow>& rows);

/// Relative change, at the start, of forces (turned back), of the forces between cells, of the
/// cells' stresses, of gamma_eff, of sigma_nn (law `traction`) and of totals, that shift and turn
/// of [start] make: 0 but for rounding. The largest of them; a scene that turns is turned by random
/// rotations of its seed as well. Throws Error as Engine does.
[[nodiscard]] double force_change_by_motion(const scene::Scene& scene, int threads);

}  // namespace spheroscope::reports
