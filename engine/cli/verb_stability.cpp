#include "engine/base/counted.hpp"
#include "engine/cli/interrupt.hpp"
#include "engine/cli/json_output.hpp"
#include "engine/cli/log.hpp"
#include "engine/cli/progress.hpp"
#include "engine/cli/report_output.hpp"
#include "engine/cli/verb.hpp"
#include "engine/reports/stability.hpp"
#include "engine/reports/step_ladder.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>

namespace spheroscope::cli {
namespace {

struct StabilityArguments {
    std::vector<std::string> scenes;
    bool steps = false;
    CommonOptions common;
};

std::vector<std::string> scenes_of(const std::string& name) {
    std::vector<std::string> files;
    const std::filesystem::path folder = std::filesystem::path(SPHEROSCOPE_SCENES_DIR) / name;
    std::error_code failed;
    for (const auto& entry : std::filesystem::directory_iterator(folder, failed))
        if (entry.path().extension() == ".toml") files.push_back(entry.path().string());
    if (failed || files.empty())
        throw Error(folder.string() + ": no scenes are there", "name the scenes to run");
    std::sort(files.begin(), files.end());
    return files;
}

reports::ReportTable table_of(const std::vector<reports::StabilityRow>& rows) {
    reports::ReportTable table;
    table.columns = {{"scene"},
                     {"variant"},
                     {"law"},
                     {"method"},
                     {"expectation"},
                     {"outcome"},
                     {"t_s"},
                     {"steps"},
                     {"rejected", false},
                     {"wall_s"},
                     {"largest_step_h0", false},
                     {"force_change", false},
                     {"pull_off_over_W", false},
                     {"state_hash", false},
                     {"met"},
                     {"message", false},
                     {"failures", false}};
    for (const reports::StabilityRow& row : rows) {
        std::string failures;
        for (const std::string& failure : row.failures)
            failures += (failures.empty() ? "" : "; ") + failure;
        const bool has_numbers = row.was_run && !row.is_refused;
        const auto number = [&](auto value) -> reports::TableCell {
            if (!has_numbers) return reports::Missing{"-"};
            return value;
        };
        table.rows.push_back({row.scene, row.variant, row.law, std::string(row.method->name),
                              row.expectation, row.outcome(), number(row.run.time_s),
                              number(row.run.work.steps), number(row.run.work.rejected_steps),
                              number(row.run.wall_s), number(row.largest_step_h0),
                              number(row.force_change), number(row.pull_off_over_W),
                              hash_text(row.run.state_hash), row.met(), row.run.message, failures});
    }
    return table;
}

nlohmann::json json_of(const std::vector<reports::StabilityRow>& rows) {
    nlohmann::json runs = nlohmann::json::array();
    for (const reports::StabilityRow& row : rows) {
        nlohmann::json measures = nlohmann::json::array();
        for (const Expectation& measure : row.measures)
            measures.push_back({{"measure", measure.measure},
                                {"value", number_or_null(measure.value)},
                                {"min", number_or_null(measure.min)},
                                {"max", number_or_null(measure.max)},
                                {"met", measure.met}});
        runs.push_back({{"scene", row.scene},
                        {"variant", row.variant},
                        {"law", row.law},
                        {"method", row.method->name},
                        {"expectation", row.expectation},
                        {"outcome", row.outcome()},
                        {"met", row.met()},
                        {"message", row.run.message},
                        {"failures", row.failures},
                        {"measures", measures},
                        {"time_s", row.run.time_s},
                        {"steps", row.run.work.steps},
                        {"largest_step_h0", number_or_null(row.largest_step_h0)},
                        {"force_change", number_or_null(row.force_change)},
                        {"pull_off_over_W", number_or_null(row.pull_off_over_W)},
                        {"wall_s", row.run.wall_s},
                        {"hash", hash_text(row.run.state_hash)}});
    }
    return runs;
}

std::string notes_of(const std::vector<reports::StabilityRow>& rows) {
    std::string text;
    std::size_t n_met = 0, n_run = 0;
    for (const reports::StabilityRow& row : rows) {
        n_met += row.met() ? 1 : 0;
        n_run += row.was_run ? 1 : 0;
        for (const std::string& failure : row.failures)
            text += fmt::format("NOT MET  {} {} {}: {}\n", row.scene, row.variant, row.method->name,
                                failure);
    }
    return text + fmt::format("{} of {} met, {} not run\n", n_met,
                              counted(rows.size(), "expectation"), rows.size() - n_run);
}

/// "NOT MET ..." with a line's end, or "" for a ladder whose estimate is good.
std::string complaint_about(const reports::StepLadder& ladder) {
    const double ratio = ladder.estimate_over_stable();
    if (!std::isfinite(ratio))
        return fmt::format(
            "NOT MET  {} {}: there is no {} to compare with\n", ladder.scene, ladder.method->name,
            std::isfinite(ladder.largest_stable_s) ? "estimate of the largest step"
                                                   : "step that holds and is the largest");
    if (reports::is_estimate_good(ladder)) return "";
    return fmt::format("NOT MET  {} {}: the estimate is {:.3g} of the largest step that holds, not "
                       "in [{:g}, {:g}]\n",
                       ladder.scene, ladder.method->name, ratio,
                       reports::k_least_estimate_over_stable, reports::k_most_estimate_over_stable);
}

reports::ReportTable table_of(const std::vector<reports::StepLadder>& ladders) {
    reports::ReportTable table;
    table.columns = {{"scene"},      {"method"},     {"stable_s"},
                     {"unstable_s"}, {"estimate_s"}, {"estimate_over_stable"},
                     {"met"},        {"trials"},     {"why"}};
    for (const reports::StepLadder& ladder : ladders) {
        std::string why;  // the last step that blew up
        for (const reports::StepTrial& trial : ladder.trials)
            if (!trial.is_stable) why = trial.why;
        table.rows.push_back({ladder.scene, std::string(ladder.method->name),
                              ladder.largest_stable_s, ladder.smallest_unstable_s,
                              ladder.estimate_s, ladder.estimate_over_stable(),
                              reports::is_estimate_good(ladder),
                              static_cast<std::int64_t>(ladder.trials.size()), why});
    }
    return table;
}

nlohmann::json json_of(const reports::StepLadder& ladder, const std::string& file) {
    nlohmann::json trials = nlohmann::json::array();
    for (const reports::StepTrial& trial : ladder.trials)
        trials.push_back({{"dt_s", trial.dt_s},
                          {"stable", trial.is_stable},
                          {"speed_ratio", number_or_null(trial.speed_ratio)},
                          {"why", trial.why}});
    return {{"scene", file},
            {"method", ladder.method->name},
            {"largest_stable_s", number_or_null(ladder.largest_stable_s)},
            {"smallest_unstable_s", number_or_null(ladder.smallest_unstable_s)},
            {"estimate_s", number_or_null(ladder.estimate_s)},
            {"estimate_over_stable", number_or_null(ladder.estimate_over_stable())},
            {"met", reports::is_estimate_good(ladder)},
            {"trials", trials}};
}

/// The steps at which explicit methods blow up, beside the program's own estimates.
ExitCode climb(const StabilityArguments& arguments, const reports::DrawPlot& draw,
               const Invocation& invocation) {
    const std::vector<std::string> files =
        arguments.scenes.empty() ? scenes_of("bench") : arguments.scenes;
    const InterruptGuard interrupts;
    Progress progress(progress_style(arguments.common.quiet));
    reports::StepLadderOptions options;
    options.threads = arguments.common.n_threads();
    options.stop = &interrupts.stop();
    nlohmann::json ladders = nlohmann::json::array();
    std::vector<reports::StepLadder> climbed;
    std::string not_met, interrupted;
    for (const std::string& file : files) {
        constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
        progress.update({file, unknown, unknown, unknown});
        const scene::Scene scene = scene::load_scene(file, arguments.common.overrides());
        for (const reports::StepLadder& ladder : reports::climb_steps(scene, options)) {
            if (ladder.is_interrupted) {
                interrupted += fmt::format("interrupted  {} {}: not in the table\n", ladder.scene,
                                           ladder.method->name);
                continue;
            }
            not_met += complaint_about(ladder);
            ladders.push_back(json_of(ladder, file));
            climbed.push_back(ladder);
        }
        if (interrupts.stop().load()) break;
    }
    progress.clear();
    const reports::ReportTable table = table_of(climbed);
    const std::string path = report_folder(arguments.common, "out/stability") + "/steps";
    write_text_file(path + ".csv",
                    table.csv_text(report_comments(invocation, arguments.common.n_threads())));
    std::vector<std::string> written{path + ".csv"};
    const reports::Plot plot = reports::step_ladder_plot(climbed);
    if (!plot.panels.empty())
        for (const std::string& file : draw_report_plot(draw, plot, path)) written.push_back(file);
    if (arguments.common.json) {
        print_json({{"ladders", ladders},
                    {"complete", !interrupts.stop().load()},
                    {"machine", machine_json(invocation, arguments.common.n_threads())},
                    {"files", written}});
    } else {
        fmt::print("{}\n{}{}", table.aligned_text(), not_met, interrupted);
        for (const std::string& file : written) fmt::print("written to {}\n", file);
    }
    return code_after_signal(not_met.empty() ? ExitCode::ok : ExitCode::differs);
}

ExitCode stability(const StabilityArguments& arguments, const reports::DrawPlot& draw,
                   const Invocation& invocation) {
    if (arguments.common.quiet) make_log_quiet();
    if (arguments.steps) {
        if (arguments.common.time_limit_s())
            throw Error("--steps and --time-limit exclude each other",
                        "a step that is not run to its end is neither held nor blown up");
        return climb(arguments, draw, invocation);
    }
    const std::vector<std::string> files =
        arguments.scenes.empty() ? scenes_of("stress") : arguments.scenes;
    const InterruptGuard interrupts;
    Progress progress(progress_style(arguments.common.quiet));
    reports::StabilityOptions options;
    options.threads = arguments.common.n_threads();
    options.wall_limit_s = arguments.common.time_limit_s().value_or(0.0);
    options.stop = &interrupts.stop();
    options.progress = [&](const std::string& what, double share) {
        constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
        progress.update({what, share, unknown, unknown});
    };
    const std::vector<reports::StabilityRow> rows =
        reports::check_stability(files, arguments.common.overrides(), options);
    progress.clear();

    const std::string folder = report_folder(arguments.common, "out/stability");
    const std::string path = folder + "/stability";
    const reports::ReportTable table = table_of(rows);
    write_text_file(path + ".csv",
                    table.csv_text(report_comments(invocation, arguments.common.n_threads())));
    std::vector<std::string> written{path + ".csv"};
    const reports::Plot plot = reports::stability_plot(rows);
    if (!plot.panels.empty())
        for (const std::string& file : draw_report_plot(draw, plot, path)) written.push_back(file);

    if (arguments.common.json) {
        print_json({{"runs", json_of(rows)},
                    {"machine", machine_json(invocation, arguments.common.n_threads())},
                    {"files", written}});
    } else {
        fmt::print("{}\n{}", table.aligned_text(), notes_of(rows));
        for (const std::string& file : written) fmt::print("written to {}\n", file);
    }
    ExitCode code = ExitCode::ok;
    for (const reports::StabilityRow& row : rows)
        if (!row.was_run && code == ExitCode::ok)
            code = ExitCode::not_converged;
        else if (row.was_run && !row.met())
            code = ExitCode::differs;
    return code_after_signal(code);
}

}  // namespace

Verb stability_verb(const reports::DrawPlot& draw) {
    return {"stability", "stiff and extreme scenes with every method; exit code 4 if one surprises",
            [draw](CommandLine& command) -> VerbAction {
                const auto arguments = std::make_shared<StabilityArguments>();
                command.optional_arguments(
                    "SCENES", arguments->scenes,
                    "scenes that say what must hold (default: all of scenes/stress)");
                command.flag("--steps", arguments->steps,
                             "raise the step of explicit methods until they blow up, beside "
                             "the program's own estimate, which must be 0.7 to 1 of what holds "
                             "(default: scenes/bench)");
                add_common_options(command, arguments->common,
                                   {CommonOption::output_folder, CommonOption::threads,
                                    CommonOption::seed, CommonOption::set, CommonOption::json,
                                    CommonOption::quiet, CommonOption::time_limit});
                return [arguments, draw](const Invocation& invocation) {
                    return stability(*arguments, draw, invocation);
                };
            }};
}

}  // namespace spheroscope::cli
