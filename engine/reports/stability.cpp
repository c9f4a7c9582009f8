// What must hold is in the scenes; this file only looks whether it does. A run has three honest
// ends: it comes to its end and meets [expect], it stops and says why, or it is refused. Whatever
// comes to its end with other numbers is quietly wrong, and that is what this report is for.

#include "engine/reports/stability.hpp"

#include "engine/reports/machine.hpp"
#include "engine/reports/pull_off_work.hpp"
#include "engine/reports/variants.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <string_view>

namespace spheroscope::reports {
namespace {

constexpr double k_undefined = std::numeric_limits<double>::quiet_NaN();

/// "" for explicit methods that adapt to what stability asks for: they are neither.
std::string_view class_of(const MethodRow& method) {
    if (method.needs_stiffness) return "implicit";
    return method.adaptive() ? "" : "explicit";
}

void check_rules(const scene::Scene& scene) {
    for (const scene::Stability& rule : scene.stability) {
        const bool is_class =
            rule.methods == "all" || rule.methods == "explicit" || rule.methods == "implicit";
        if (!is_class && find_method(rule.methods) == nullptr)
            throw Error(rule.loc,
                        fmt::format("[stability.{}]: there is no such method, and no such "
                                    "class of methods",
                                    rule.methods),
                        "classes are explicit, implicit and all");
        if (rule.forces_kept > 0.0 && !scene.start)
            throw Error(rule.loc, "stability.forces_kept compares with a configuration that is not "
                                  "moved: it needs [start] with turn or shift");
    }
    for (const MethodRow& method : all_methods())
        if (stability_rule(scene, method) == nullptr)
            throw Error(Loc{scene.file, 0, 0},
                        fmt::format("the scene does not say what it expects of {}", method.name),
                        "add [stability.all]");
}

std::string words_of(const scene::Stability& rule) {
    std::string reason;
    if (!rule.names.empty()) reason = fmt::format(", naming '{}'", fmt::join(rule.names, "', '"));
    if (rule.within_s > 0.0) reason += fmt::format(", within {:g} s", rule.within_s);
    std::string bounds;
    if (rule.largest_step_h0 > 0.0)
        bounds += fmt::format(", steps <= {:g} h0", rule.largest_step_h0);
    if (rule.forces_kept > 0.0) bounds += fmt::format(", forces kept to {:g}", rule.forces_kept);
    if (rule.pull_off > 0.0) bounds += fmt::format(", pull-off work W to {:g}", rule.pull_off);
    switch (rule.outcome) {
    case scene::StabilityOutcome::ends: return "ends" + bounds;
    case scene::StabilityOutcome::stops: return "stops" + reason;
    case scene::StabilityOutcome::either: return "ends" + bounds + ", or stops" + reason;
    }
    return "";
}

void judge_end(const scene::Stability& rule, StabilityRow& row) {
    if (rule.outcome == scene::StabilityOutcome::stops)
        row.failures.push_back(
            fmt::format("came to its end at t = {:g} s, and should have stopped", row.run.time_s));
    for (const Expectation& measure : row.measures)
        if (!measure.met)
            row.failures.push_back(fmt::format("{} = {:.6g} {}, not in [{:.6g}, {:.6g}]",
                                               measure.measure, measure.value, measure.unit,
                                               measure.min, measure.max));
    if (rule.largest_step_h0 > 0.0 && !(row.largest_step_h0 <= rule.largest_step_h0))
        row.failures.push_back(fmt::format("a node moved {:.3g} h0 in one step, more than {:g}",
                                           row.largest_step_h0, rule.largest_step_h0));
    if (rule.forces_kept > 0.0 && !(row.force_change <= rule.forces_kept))
        row.failures.push_back(fmt::format("forces changed by {:.3g}, more than {:g}",
                                           row.force_change, rule.forces_kept));
    if (rule.pull_off > 0.0 && !(std::abs(row.pull_off_over_W - 1.0) <= rule.pull_off))
        row.failures.push_back(fmt::format("the pull-off work is {:.4g} W, not W to {:g}",
                                           row.pull_off_over_W, rule.pull_off));
}

/// The text has these words, and not as a part of others: 'cell' is not in 'cells'.
bool says(std::string_view text, std::string_view words) {
    const auto is_of_a_word = [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
    };
    for (std::size_t at = text.find(words); at != std::string_view::npos;
         at = text.find(words, at + 1)) {
        const std::size_t end = at + words.size();
        if ((at == 0 || !is_of_a_word(text[at - 1])) &&
            (end == text.size() || !is_of_a_word(text[end])))
            return true;
    }
    return false;
}

void judge_stop(const scene::Stability& rule, StabilityRow& row) {
    if (rule.outcome == scene::StabilityOutcome::ends)
        row.failures.push_back(fmt::format("{} at t = {:g} s, and should have come to its end: {}",
                                           row.outcome(), row.run.time_s, row.run.message));
    for (const std::string& word : rule.names)
        if (!says(row.run.message, word))
            row.failures.push_back(
                fmt::format("the reason does not name '{}': {}", word, row.run.message));
    if (row.run.message.empty()) row.failures.push_back("stopped without a reason");
    if (rule.within_s > 0.0 && row.run.time_s > rule.within_s)
        row.failures.push_back(
            fmt::format("stopped at t = {:g} s, later than {:g} s", row.run.time_s, rule.within_s));
}

constexpr double k_longer_without_time = 10.0;

/// Runs a scene that has loaded. What the engine refuses is noted, not thrown: it may be expected.
void run_row(scene::Scene scene, const scene::Stability& rule, const StabilityOptions& options,
             double wall_limit_s, StabilityRow& row) {
    scene.method.name = row.method->name;
    if (!row.method->moves_in_time()) {
        // A controller is a motion in time; where there is none, its end is held from the start.
        if (scene.cytosol) scene.cytosol->controller = scene::VolumeController::exact;
        // Nor does it come to the end of a motion in the motion's time: its steps grow until there.
        for (scene::Stage& stage : scene.stages) stage.duration_s *= k_longer_without_time;
    }
    scene = with_report_fields(scene);
    row.largest_step_h0 = row.force_change = row.pull_off_over_W = k_undefined;
    try {
        if (rule.forces_kept > 0.0)
            row.force_change = force_change_by_motion(scene, options.threads);
        MeasuredRunOptions run_options;
        run_options.threads = options.threads;
        run_options.wall_limit_s = wall_limit_s;
        run_options.stop = options.stop;
        run_options.watch_steps = rule.largest_step_h0 > 0.0;
        run_options.watch_flips = is_expected(scene, "n_flipped_triangles");
        row.run = measure_run(scene, run_options);
        if (rule.pull_off > 0.0 && row.run.is_complete() && !row.run.samples.empty())
            row.pull_off_over_W =
                pull_off_work_over_W(scene, row.run.samples.back().x_um, options.threads);
    } catch (const Error& error) {
        row.is_refused = true;
        row.run.message = error.what();
    }
    row.run.samples.clear();
    row.was_run =
        row.run.verdict != RunVerdict::time_limit && row.run.verdict != RunVerdict::stopped;
    if (!row.was_run) return;
    if (rule.largest_step_h0 > 0.0)
        row.largest_step_h0 = row.run.largest_step_um / scene.contact->h0_um;
    if (!row.is_refused && row.run.is_complete()) {
        row.measures = check_expectations(scene, row.run);
        judge_end(rule, row);
    } else {
        judge_stop(rule, row);
    }
}

/// "cortex.elastic.E=20 kPa": key, 20, "kPa".
void note_what_varies(const std::string& setting, StabilityRow& row) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos) return;
    row.varied_key = setting.substr(0, equals);
    const std::string value = setting.substr(equals + 1);
    char* end = nullptr;
    row.varied_value = std::strtod(value.c_str(), &end);
    if (end == value.c_str()) row.varied_value = k_undefined;
    row.varied_unit = value.substr(static_cast<std::size_t>(end - value.c_str()));
    row.varied_unit.erase(0, row.varied_unit.find_first_not_of(' '));
}

std::string stem_of(const std::string& file) {
    const std::string name = file.substr(file.find_last_of('/') + 1);
    return name.substr(0, name.find_last_of('.'));
}

}  // namespace

std::string StabilityRow::outcome() const {
    if (!was_run && !is_refused) return "not run";
    if (is_refused) return "refused";
    return run.is_complete() ? "ended" : "stopped";
}

std::vector<Expectation> check_expectations(const scene::Scene& scene, const MeasuredRun& run) {
    std::vector<Expectation> measures = spheroscope::check_expectations(scene, run.end.totals);
    for (Expectation& measure : measures) {
        if (measure.measure != "n_flipped_triangles") continue;
        measure.value = run.most_flipped_triangles;
        measure.met = measure.value >= measure.min && measure.value <= measure.max;
    }
    return measures;
}

const scene::Stability* stability_rule(const scene::Scene& scene, const MethodRow& method) {
    for (const std::string_view wanted : {method.name, class_of(method), std::string_view("all")})
        for (const scene::Stability& rule : scene.stability)
            if (rule.methods == wanted) return &rule;
    return nullptr;
}

std::vector<StabilityRow> check_stability(const std::vector<std::string>& files,
                                          const std::vector<scene::Override>& overrides,
                                          const StabilityOptions& options) {
    const double begin_s = wall_clock_s();
    std::vector<StabilityRow> rows;
    std::vector<scene::Scene> scenes;
    for (const std::string& file : files) {
        scenes.push_back(scene::load_scene(file, overrides));
        check_rules(scenes.back());
        check_expectation_names(scenes.back());
    }
    for (std::size_t f = 0; f < files.size(); ++f) {
        std::vector<scene::Variant> variants = scenes[f].variants;
        if (variants.empty()) variants.emplace_back();
        for (const scene::Variant& variant : variants) {
            std::vector<scene::Override> changes = overrides;
            for (scene::Override& change : overrides_of(variant))
                changes.push_back(std::move(change));
            scene::Scene changed = scenes[f];
            std::string refusal;
            try {
                changed = scene::load_scene(files[f], changes);
            } catch (const Error& error) {
                refusal = error.what();
                // what is expected of a scene that does not load is still read
                std::erase_if(changes, [](const scene::Override& change) {
                    return change.key.rfind("stability.", 0) != 0;
                });
                changed = scene::load_scene(files[f], changes);
            }
            for (const MethodRow& method : all_methods()) {
                const scene::Stability& rule = *stability_rule(changed, method);
                StabilityRow row;
                row.scene = stem_of(files[f]);
                row.variant = variant.name;
                row.method = &method;
                row.expectation = words_of(rule);
                if (changed.contact)
                    row.law = changed.contact->law == scene::ContactLaw::traction ? "traction"
                                                                                  : "variational";
                if (!variant.set.empty()) note_what_varies(variant.set.front(), row);
                const double left_s = options.wall_limit_s - (wall_clock_s() - begin_s);
                const bool is_late = options.wall_limit_s > 0.0 && left_s <= 0.0;
                const bool is_stopped = options.stop != nullptr && options.stop->load();
                if (options.progress)
                    options.progress(fmt::format("{} {} {}", row.scene, row.variant, method.name),
                                     static_cast<double>(f) / static_cast<double>(files.size()));
                if (!refusal.empty()) {
                    row.is_refused = row.was_run = true;
                    row.run.message = refusal;
                    row.largest_step_h0 = row.force_change = row.pull_off_over_W = k_undefined;
                    judge_stop(rule, row);
                } else if (!is_late && !is_stopped) {
                    run_row(changed, rule, options, options.wall_limit_s > 0.0 ? left_s : 0.0, row);
                }
                rows.push_back(std::move(row));
            }
        }
    }
    return rows;
}

Plot stability_plot(const std::vector<StabilityRow>& rows) {
    Plot plot;
    plot.title = "Mean step of the runs that ended as expected";
    std::map<std::string, std::size_t> panel_of;
    for (const StabilityRow& row : rows) {
        const bool counts = row.met() && row.run.is_complete() && !row.is_refused &&
                            row.varied_value > 0.0 && row.run.work.steps > 0;
        if (!counts) continue;
        const auto [place, is_new] = panel_of.emplace(row.scene, plot.panels.size());
        if (is_new)
            plot.panels.push_back(
                {row.scene,
                 row.varied_key + (row.varied_unit.empty() ? "" : " (" + row.varied_unit + ")"),
                 "mean step (s)",
                 {}});
        Plot::Panel& panel = plot.panels[place->second];
        auto series = std::find_if(panel.series.begin(), panel.series.end(),
                                   [&](const auto& s) { return s.name == row.method->name; });
        if (series == panel.series.end())
            series = panel.series.insert(series, {std::string(row.method->name), {}, {}});
        series->x.push_back(row.varied_value);
        series->y.push_back(row.run.time_s / static_cast<double>(row.run.work.steps));
    }
    const auto is_short = [](const Plot::Panel& panel) {
        std::size_t most = 0;
        for (const Plot::Series& series : panel.series) most = std::max(most, series.x.size());
        return most < 3;
    };
    plot.panels.erase(std::remove_if(plot.panels.begin(), plot.panels.end(), is_short),
                      plot.panels.end());
    return plot;
}

}  // namespace spheroscope::reports
