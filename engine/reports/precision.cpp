// Error against run time. What makes the numbers trustworthy:
//
//   * All runs start from the same bits and are compared at the same output times.
//   * The reference has a known error. For a method of order p the runs at h and 2h differ by
//     (2^p - 1) times the error at h, up to higher orders; the difference itself is taken as the
//     error of the reference, which is what it is for p = 1 and too large for p > 1.
//   * A number is shown only if it is ten times the reference's own error; so no error in the table
//     is wrong by more than 10 %.

#include "engine/reports/precision.hpp"

#include "engine/reports/machine.hpp"
#include "engine/stages/choices.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace spheroscope::reports {
namespace {

/// Smallest error in the table over the error of the reference.
constexpr double k_margin = 10.0;
/// Linear systems of the reference are solved to this relative residual.
constexpr double k_reference_linear_tolerance = 1e-8;
/// Used for adaptive methods where the scene has fixed steps: the default of the scene key.
constexpr double k_standard_tolerance_um = 0.006;
/// Share of the time limit that the table may take; the rest is for the reference.
constexpr double k_table_share = 0.5;

double remaining_s(double limit_s, double begin_s) {
    return limit_s > 0.0 ? limit_s - (wall_clock_s() - begin_s)
                         : std::numeric_limits<double>::infinity();
}

MeasuredRun run_with(const scene::Scene& scene, const MethodSetting& setting,
                     const PrecisionOptions& options, double wall_limit_s) {
    return measure_run(setting.applied_to(scene),
                       {.threads = options.threads,
                        .wall_limit_s = std::isfinite(wall_limit_s) ? wall_limit_s : 0.0,
                        .stop = options.stop});
}

/// The same bits each time; the times are the least.
void run_row(const scene::Scene& scene, const PrecisionOptions& options, double wall_limit_s,
             PrecisionRow& row) {
    Repetitions repetitions = options.repetitions;
    repetitions.stop = options.stop;
    for (Repetitions::Count count(repetitions); count.goes_on();) {
        MeasuredRun run = run_with(scene, row.setting, options, wall_limit_s);
        if (row.n_runs == 0) {
            row.run = std::move(run);
        } else if (run.verdict == row.run.verdict) {
            row.run.wall_s = std::min(row.run.wall_s, run.wall_s);
            row.run.cpu_s = std::min(row.run.cpu_s, run.cpu_s);
        }
        row.n_runs = count.n_begun();
    }
    row.was_run = true;
}

/// The method for the reference: the highest order, then the cheapest step. nullptr if no method
/// came through at its finest setting.
const MethodRow* reference_method(const std::vector<PrecisionRow>& rows) {
    const MethodRow* best = nullptr;
    double best_step_s = 0.0;
    for (const PrecisionRow& row : rows) {
        if (!row.run.is_complete() || row.run.work.steps == 0 || row.setting.method->order < 1)
            continue;
        const double step_s = row.run.cpu_s / static_cast<double>(row.run.work.steps);
        const MethodRow* method = row.setting.method;
        const bool is_better =
            best == nullptr || method->order > best->order ||
            (method->order == best->order && method != best && step_s < best_step_s);
        if (method == best) best_step_s = std::min(best_step_s, step_s);
        if (!is_better) continue;
        best = method;
        best_step_s = step_s;
    }
    return best;
}

bool has_contacts_in_floats(const scene::Scene& scene) {
    return scene.contact && scene.contact->law == scene::ContactLaw::traction &&
           scene.contact->precision == scene::Precision::single_precision;
}

bool was_stopped(const PrecisionOptions& options) {
    return options.stop != nullptr && options.stop->load();
}

void compare_rows(Precision& precision, const MeasuredRun& reference) {
    for (PrecisionRow& row : precision.rows)
        if (row.was_run && row.run.is_complete())
            row.errors = compute_errors(row.run, reference, precision.scales);
}

/// Halves the step until the reference is fine enough, or time or halvings are used up.
void make_reference(const scene::Scene& scene, const PrecisionOptions& options, double begin_s,
                    Precision& precision) {
    const MethodRow* const method = reference_method(precision.rows);
    if (method == nullptr) return;
    MethodSetting setting{method, scene.method.dt_s, 0.0, k_reference_linear_tolerance};
    std::optional<MeasuredRun> coarse;
    double last_s = 0.0;
    for (int halvings = 0; halvings <= options.most_reference_halvings; ++halvings) {
        const double left_s = remaining_s(options.wall_limit_s, begin_s);
        if (left_s < 2.0 * last_s || left_s <= 0.0 || was_stopped(options)) {
            precision.met_time_limit = true;
            break;
        }
        if (options.progress)
            options.progress("reference, " + setting.text(),
                             static_cast<double>(halvings) / options.most_reference_halvings);
        MeasuredRun fine = run_with(scene, setting, options, left_s);
        last_s = fine.wall_s;
        if (fine.is_complete()) {
            if (coarse) {
                precision.reference = setting;
                precision.second = setting;
                precision.second.dt_s = 2.0 * setting.dt_s;
                precision.scales = error_scales(scene, fine);
                precision.reference_errors = compute_errors(*coarse, fine, precision.scales);
                for (std::size_t m = 0; m < precision.reference_errors.size(); ++m) {
                    double& error = precision.reference_errors[m];
                    if (!std::isnan(error))
                        error = std::max(error, all_error_measures()[m].resolution);
                }
                compare_rows(precision, fine);
                precision.reference_run = fine;
                if (precision.reference_is_fine_enough()) break;
            }
            coarse = std::move(fine);
        } else {
            coarse.reset();  // a step that is too long for this scene; shorter ones may hold
        }
        setting.dt_s *= 0.5;
    }
}

/// What floats change in the reference; while its samples are there.
void compare_with_doubles(scene::Scene scene, const PrecisionOptions& options, double begin_s,
                          Precision& precision) {
    if (!precision.reference || !has_contacts_in_floats(scene) || was_stopped(options)) return;
    const double left_s = remaining_s(options.wall_limit_s, begin_s);
    if (left_s <= 0.0) {
        precision.met_time_limit = true;
        return;
    }
    if (options.progress) options.progress("reference in double", 1.0);
    scene.contact->precision = scene::Precision::double_precision;
    const MeasuredRun in_double = run_with(scene, *precision.reference, options, left_s);
    if (in_double.is_complete())
        precision.cost_of_floats =
            compute_errors(precision.reference_run, in_double, precision.scales);
    else if (in_double.verdict == RunVerdict::time_limit)
        precision.met_time_limit = true;
}

}  // namespace

std::string MethodSetting::text() const {
    return is_fixed() ? fmt::format("dt = {:.4g} ms", 1e3 * dt_s)
                      : fmt::format("tolerance = {:.4g} nm", 1e3 * tolerance_um);
}

scene::Scene MethodSetting::applied_to(const scene::Scene& scene) const {
    scene::Scene changed = scene;
    changed.method.name = method->name;
    changed.method.dt_s = dt_s;
    changed.method.tolerance_um = tolerance_um;
    changed.method.linear_tolerance = linear_tolerance;
    return changed;
}

MethodSetting own_setting(const scene::Scene& scene) {
    const MethodRow& method = chosen_method(scene);
    return {&method, scene.method.dt_s, method.adaptive() ? scene.method.tolerance_um : 0.0,
            scene.method.linear_tolerance};
}

double standard_tolerance_um(const scene::Scene& scene) {
    return scene.method.tolerance_um > 0.0 ? scene.method.tolerance_um : k_standard_tolerance_um;
}

std::vector<MethodSetting> ladder(const MethodRow& method, const scene::Scene& scene,
                                  int n_levels) {
    std::vector<MethodSetting> settings;
    const double own_um = standard_tolerance_um(scene);
    for (int level = 0; level < n_levels; ++level) {
        // An adaptive method at a coarse tolerance is held by its bound on displacements, and all
        // of its coarse rows are the same: its ladder goes further down.
        const int own_level = n_levels / 2 - (method.adaptive() ? 1 : 0);
        const double factor = std::pow(2.0, own_level - level);
        MethodSetting setting{&method, scene.method.dt_s, 0.0,
                              std::min(0.1, factor * scene.method.linear_tolerance)};
        if (method.adaptive())
            setting.tolerance_um = own_um * factor * factor;
        else
            setting.dt_s *= factor;
        settings.push_back(setting);
    }
    return settings;
}

bool Precision::is_resolved(const PrecisionRow& row, std::size_t measure) const {
    return row.errors[measure] >= k_margin * reference_errors[measure];
}

bool Precision::reference_is_fine_enough() const {
    for (const PrecisionRow& row : rows)
        for (std::size_t m = 0; m < row.errors.size(); ++m)
            if (!std::isnan(row.errors[m]) && !is_resolved(row, m)) return false;
    return true;
}

Precision compute_precision(const scene::Scene& scene, const PrecisionOptions& options) {
    const double begin_s = wall_clock_s();
    const scene::Scene fixed = with_fixed_outputs(scene, options.n_outputs);
    Precision precision;
    for (const MethodRow& method : all_methods()) {
        if (!method.moves_in_time()) continue;  // there is no motion to compare
        for (const MethodSetting& setting : ladder(method, scene, options.n_levels))
            precision.rows.push_back({setting, false, {}, 0, {}});
    }
    double done = 0.0;
    for (PrecisionRow& row : precision.rows) {
        const double left_s = remaining_s(k_table_share * options.wall_limit_s, begin_s);
        if (left_s <= 0.0 || was_stopped(options)) {
            precision.met_time_limit = true;
            break;
        }
        if (options.progress)
            options.progress(fmt::format("{}, {}", row.setting.method->name, row.setting.text()),
                             done++ / static_cast<double>(precision.rows.size()));
        run_row(fixed, options, left_s, row);
        if (row.run.verdict == RunVerdict::time_limit) precision.met_time_limit = true;
    }
    make_reference(fixed, options, begin_s, precision);
    compare_with_doubles(fixed, options, begin_s, precision);
    precision.reference_run.samples.clear();
    for (PrecisionRow& row : precision.rows) row.run.samples.clear();
    return precision;
}

}  // namespace spheroscope::reports
