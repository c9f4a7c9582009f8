#include "engine/reports/step_ladder.hpp"

#include "engine/reports/error_measures.hpp"
#include "engine/solve/explicit_bound.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace spheroscope::reports {
namespace {

constexpr double k_undefined = std::numeric_limits<double>::quiet_NaN();

/// An error that no accuracy explains: the run has left the motion.
struct Bound {
    std::string_view measure;
    double largest;
};
constexpr std::array<Bound, 2> k_bounds{{{"gamma_eff", 0.5}, {"contact_area", 0.1}}};
/// Steps that hold change the speed of creeping cells by a few percent, the first ones that do not
/// by factors of three and more.
constexpr double k_fastest = 2.0;
/// What is slower stands still, and a ratio to it says nothing.
constexpr double k_still_um_per_s = 1e-6;
/// Ten steps are too few to see nodes bounce: thirteen cells then seem to hold at 1.6 times the
/// limit.
constexpr double k_fewest_steps = 100.0;

class Climb {
  public:
    Climb(const scene::Scene& scene, const MethodRow& method, const StepLadderOptions& options)
        : scene_(with_fixed_outputs(scene, 1)), options_(options) {
        scene_.method.name = method.name;
        scene_.method.tolerance_um = 0.0;
        ladder_.method = &method;
        ladder_.scene = scene.title;
        ladder_.largest_stable_s = ladder_.smallest_unstable_s = ladder_.estimate_s = k_undefined;
    }

    StepLadder climb() {
        find_estimate();
        const double wanted_s = k_fewest_steps * ladder_.estimate_s;
        if (scene::Stage& last = scene_.stages.back();
            !ladder_.is_interrupted && last.duration_s < wanted_s) {
            last.duration_s = last.every_s = wanted_s;
            find_estimate();  // contacts have grown in that time
        }
        if (ladder_.is_interrupted || std::isnan(ladder_.estimate_s)) return std::move(ladder_);
        scene_.method.stable_step = scene::StableStep::ignore;
        reference_ = run(0.25 * ladder_.estimate_s);
        if (!reference_.is_complete()) return std::move(ladder_);
        scales_ = error_scales(scene_, reference_);
        for (int k = 0; k <= 8; ++k) {
            const double dt_s = ladder_.estimate_s * std::pow(2.0, 0.5 * k - 1.0);
            if (!note(dt_s)) break;
        }
        for (int k = 0; k < options_.n_bisections && !ladder_.is_interrupted; ++k) {
            if (std::isnan(ladder_.largest_stable_s) || std::isnan(ladder_.smallest_unstable_s))
                break;
            note(std::sqrt(ladder_.largest_stable_s * ladder_.smallest_unstable_s));
        }
        return std::move(ladder_);
    }

  private:
    MeasuredRun run(double dt_s) {
        scene_.method.dt_s = dt_s;
        MeasuredRun done =
            measure_run(scene_, {.threads = options_.threads, .stop = options_.stop});
        ladder_.is_interrupted = done.verdict == RunVerdict::stopped;
        return done;
    }

    /// The estimate comes out of a run that holds, and that run needs a step: halve the scene's own
    /// until it is not refused.
    void find_estimate() {
        double dt_s = scene_.method.dt_s;
        for (int k = 0; k < 12; ++k, dt_s *= 0.5) {
            const MeasuredRun done = run(dt_s);
            if (ladder_.is_interrupted) return;
            if (!done.is_complete()) continue;
            if (done.fastest_rate_per_s > 0.0)
                ladder_.estimate_s =
                    ExplicitBound::k_largest_dt_times_rate / done.fastest_rate_per_s;
            return;
        }
    }

    /// Tries a step and notes what came of it, unless it was stopped; true if it holds.
    bool note(double dt_s) {
        const MeasuredRun done = run(dt_s);
        if (ladder_.is_interrupted) return false;
        StepTrial trial{dt_s, done.is_complete(), done.message, k_undefined};
        if (trial.is_stable) judge(done, trial);
        (trial.is_stable ? ladder_.largest_stable_s : ladder_.smallest_unstable_s) = dt_s;
        ladder_.trials.push_back(trial);
        return trial.is_stable;
    }

    /// What a run that came to its end looks like there.
    void judge(const MeasuredRun& done, StepTrial& trial) const {
        trial.speed_ratio =
            done.end.totals.normal_speed_rms_um_per_s /
            std::max(reference_.end.totals.normal_speed_rms_um_per_s, k_still_um_per_s);
        if (!(trial.speed_ratio <= k_fastest)) {
            trial.is_stable = false;
            trial.why = fmt::format("nodes are {:.3g} times too fast", trial.speed_ratio);
        }
        for (const Bound& bound : k_bounds)
            for (const ErrorMeasure& measure : all_error_measures()) {
                if (measure.name != bound.measure) continue;
                const double error = measure.compute(done, reference_, scales_);
                if (std::isnan(error) || error <= bound.largest) continue;
                trial.is_stable = false;
                trial.why = fmt::format("{} is off by {:.3g}", measure.name, error);
            }
    }

    scene::Scene scene_;
    StepLadderOptions options_;
    StepLadder ladder_;
    MeasuredRun reference_;
    ErrorScales scales_;
};

}  // namespace

bool is_estimate_good(const StepLadder& ladder) {
    const double ratio = ladder.estimate_over_stable();
    return ratio >= k_least_estimate_over_stable && ratio <= k_most_estimate_over_stable;
}

std::vector<StepLadder> climb_steps(const scene::Scene& scene, const StepLadderOptions& options) {
    std::vector<StepLadder> ladders;
    for (const MethodRow& method : all_methods()) {
        if (method.needs_stiffness || method.adaptive()) continue;
        ladders.push_back(Climb(scene, method, options).climb());
        if (ladders.back().is_interrupted) break;
    }
    return ladders;
}

Plot step_ladder_plot(const std::vector<StepLadder>& ladders) {
    Plot plot;
    plot.title = "Explicit steps, up to where they blow up";
    for (const StepLadder& ladder : ladders) {
        Plot::Panel panel{ladder.scene, "step (s)", "speed of nodes over the reference's", {}};
        Plot::Series holds{"holds", {}, {}}, fails{"does not hold", {}, {}};
        std::vector<StepTrial> trials = ladder.trials;
        std::sort(trials.begin(), trials.end(),
                  [](const StepTrial& p, const StepTrial& q) { return p.dt_s < q.dt_s; });
        double least = std::numeric_limits<double>::infinity(), most = 0.0;
        for (const StepTrial& trial : trials) {
            if (!(trial.speed_ratio > 0.0) || !std::isfinite(trial.speed_ratio)) continue;
            Plot::Series& series = trial.is_stable ? holds : fails;
            series.x.push_back(trial.dt_s);
            series.y.push_back(trial.speed_ratio);
            least = std::min(least, trial.speed_ratio);
            most = std::max(most, trial.speed_ratio);
        }
        for (Plot::Series* series : {&holds, &fails})
            if (!series->x.empty()) panel.series.push_back(std::move(*series));
        if (panel.series.empty()) continue;
        if (ladder.estimate_s > 0.0)
            panel.series.push_back(
                {"the program's own limit", {ladder.estimate_s, ladder.estimate_s}, {least, most}});
        plot.panels.push_back(std::move(panel));
    }
    return plot;
}

}  // namespace spheroscope::reports
