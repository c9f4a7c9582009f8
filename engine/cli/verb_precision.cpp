#include "engine/cli/interrupt.hpp"
#include "engine/cli/json_output.hpp"
#include "engine/cli/log.hpp"
#include "engine/cli/precision_text.hpp"
#include "engine/cli/progress.hpp"
#include "engine/cli/report_output.hpp"
#include "engine/cli/verb.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace spheroscope::cli {
namespace {

constexpr int k_levels = 5, k_most_nodes = 2562;

struct PrecisionArguments {
    std::string scene;
    bool mesh = false;
    std::optional<int> levels;
    std::optional<int> most_nodes;
    CommonOptions common;
};

/// Writes table, plot and JSON of one report, and prints one of them.
void give_out(const std::string& path, const reports::ReportTable& table, const std::string& notes,
              nlohmann::json document, const reports::DrawPlot& draw, const reports::Plot& plot,
              const PrecisionArguments& arguments, const Invocation& invocation) {
    // Errors without what they are against are half a table.
    std::vector<std::string> comments = report_comments(invocation, arguments.common.n_threads());
    std::istringstream lines(notes);
    for (std::string line; std::getline(lines, line);) comments.push_back(line);
    write_text_file(path + ".csv", table.csv_text(comments));
    std::vector<std::string> files{path + ".csv"};
    for (const std::string& file : draw_report_plot(draw, plot, path)) files.push_back(file);
    if (arguments.common.json) {
        document["scene"] = arguments.scene;
        document["machine"] = machine_json(invocation, arguments.common.n_threads());
        document["files"] = files;
        print_json(document);
        return;
    }
    fmt::print("{}\n{}", table.aligned_text(), notes);
    for (const std::string& file : files) fmt::print("written to {}\n", file);
}

ExitCode precision(const PrecisionArguments& arguments, const reports::DrawPlot& draw,
                   const Invocation& invocation) {
    if (arguments.common.quiet) make_log_quiet();
    if (arguments.levels && arguments.mesh)
        throw Error("--levels is about steps and tolerances, and these are mesh levels",
                    "--most-nodes says which is the finest");
    if (arguments.most_nodes && !arguments.mesh)
        throw Error("--most-nodes is about mesh levels, and these are steps and tolerances",
                    "add --mesh, or --set cells.nodes=N for another mesh");
    const scene::Scene scene = scene::load_scene(arguments.scene, arguments.common.overrides());
    log_warnings(scene.warnings);
    const std::string folder =
        report_folder(arguments.common,
                      "out/precision/" + std::filesystem::path(arguments.scene).stem().string());

    const InterruptGuard interrupts;
    Progress progress(progress_style(arguments.common.quiet));
    reports::PrecisionOptions options;
    options.threads = arguments.common.n_threads();
    options.n_levels = arguments.levels.value_or(k_levels);
    options.wall_limit_s = arguments.common.time_limit_s().value_or(0.0);
    options.stop = &interrupts.stop();
    options.progress = [&](const std::string& what, double share) {
        constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
        progress.update({what, share, unknown, unknown});
    };
    if (arguments.mesh) {
        const reports::MeshLadder ladder = reports::compute_mesh_ladder(
            scene, arguments.most_nodes.value_or(k_most_nodes), options);
        progress.clear();
        const reports::Plot plot =
            plot_of(ladder, scene.cells.nodes, "Error against mesh: " + scene.title);
        give_out(folder + "/mesh", table_of(ladder), notes_of(ladder, scene.cells.nodes),
                 json_of(ladder, scene.cells.nodes), draw, plot, arguments, invocation);
        return code_after_signal(ladder.met_time_limit ? ExitCode::not_converged : ExitCode::ok);
    }
    const reports::Precision result = reports::compute_precision(scene, options);
    progress.clear();
    const reports::Plot plot = plot_of(result, "Error against run time: " + scene.title);
    give_out(folder + "/precision", table_of(result), notes_of(result), json_of(result), draw, plot,
             arguments, invocation);
    return code_after_signal(result.reference && !result.met_time_limit ? ExitCode::ok
                                                                        : ExitCode::not_converged);
}

}  // namespace

Verb precision_verb(const reports::DrawPlot& draw) {
    return {"precision", "error against run time of every method: table, CSV and plot",
            [draw](CommandLine& command) -> VerbAction {
                const auto arguments = std::make_shared<PrecisionArguments>();
                command.argument("SCENE", arguments->scene, "scene file");
                command.flag("--mesh", arguments->mesh,
                             "compare mesh levels instead of methods, and tell mesh error from "
                             "time error");
                command.option(
                    "--levels", arguments->levels,
                    fmt::format("steps or tolerances of each method, around the scene's own "
                                "(default: {})",
                                k_levels),
                    between(1, 12));
                command.option(
                    "--most-nodes", arguments->most_nodes,
                    fmt::format("finest level of --mesh: 42, 162, 642 or 2562 nodes (default: {})",
                                k_most_nodes),
                    one_of({42, 162, 642, 2562}));
                add_common_options(command, arguments->common,
                                   {CommonOption::output_folder, CommonOption::threads,
                                    CommonOption::seed, CommonOption::set, CommonOption::json,
                                    CommonOption::quiet, CommonOption::time_limit});
                return [arguments, draw](const Invocation& invocation) {
                    return precision(*arguments, draw, invocation);
                };
            }};
}

}  // namespace spheroscope::cli
