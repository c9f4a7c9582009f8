#include "engine/cli/json_output.hpp"
#include "engine/cli/log.hpp"
#include "engine/cli/run_seeds.hpp"
#include "engine/cli/seeds.hpp"
#include "engine/cli/simulate.hpp"
#include "engine/cli/verb.hpp"
#include "engine/store/run_file.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <vector>

namespace spheroscope::cli {
namespace {

struct RunArguments {
    std::string scene;
    std::string seeds;  ///< as given, "1..5"; empty: one run
    bool overwrite = false;
    CommonOptions common;
};

/// The scene to run, and what changes on the way.
struct Task {
    scene::Scene scene;
    std::vector<Change> changes;
};

bool is_run_file(const std::string& path) {
    return std::filesystem::path(path).extension() == ".h5";
}

/// A run is repeated from what its file holds: the resolved scene and the changes.
Task task_of(const RunArguments& arguments) {
    const CommonOptions& common = arguments.common;
    if (!is_run_file(arguments.scene))
        return {scene::load_scene(arguments.scene, common.overrides()), {}};
    if (common.output.empty())
        throw Error(arguments.scene + ": a run that is repeated needs another place",
                    common.resume ? "to go on with this run, give its scene; to repeat it from its "
                                    "beginning, name a folder with -o"
                                  : "name a folder with -o");
    const RunFileReader reader(arguments.scene);
    Task task{scene::parse_scene(reader.header()->resolved_scene, "scene in " + reader.path(),
                                 common.overrides()),
              reader.changes()};
    const std::vector<scene::Override> changed = common.overrides();
    if (std::ranges::none_of(changed,
                             [](const auto& change) { return change.key == "cells.file"; }))
        refuse_cells_beside_a_scene(task.scene, arguments.scene,
                                    "run its scene, or say where they are: --set "
                                    "'cells.file=\"FOLDER/CELLS.h5\"'");
    task.scene.file =
        reader.header()->scene_name;  // the run that is made has the name of its first
    return task;
}

ExitCode run(const RunArguments& arguments, const Invocation& invocation) {
    if (!arguments.seeds.empty()) {
        if (arguments.common.seed)
            throw Error("--seed and --seeds exclude each other", "--seeds 7 makes one run as well");
        if (is_run_file(arguments.scene))
            throw Error(arguments.scene + ": --seeds wants a scene, got the file of a run",
                        "a run is repeated with its own seed");
        return run_seeds(arguments.scene, parse_seeds(arguments.seeds), arguments.common,
                         arguments.overwrite, invocation);
    }
    const auto [scene, changes] = task_of(arguments);
    log_warnings(scene.warnings);
    const RunPlace place = run_place(arguments.scene, arguments.common);
    const SimulationSummary summary =
        simulate(scene, place, arguments.common, arguments.overwrite, invocation, changes);
    if (arguments.common.json)
        print_json(summary_json(summary, place));
    else
        fmt::print("{}", summary_text(summary, place));
    if (!summary.result.message.empty()) log_error(summary.result.message);
    return summary.code;
}

}  // namespace

Verb run_verb() {
    return {"run",
            "simulates a scene into an HDF5 file, or a run once more with what was changed in it",
            [](CommandLine& command) -> VerbAction {
                const auto arguments = std::make_shared<RunArguments>();
                command.argument("SCENE|FILE", arguments->scene,
                                 "scene file, or HDF5 file of a run");
                command.flag(
                    "--overwrite", arguments->overwrite,
                    "begin anew where a run is: unfinished, finished, or of another scene or seed");
                command.option("--seeds", arguments->seeds,
                               "one run after the other with these seeds, 1..5 or 1,4,7, each in "
                               "a folder of its own; --time-limit is that of each",
                               {.type = "SEEDS"});
                add_common_options(command, arguments->common,
                                   {CommonOption::output_folder, CommonOption::threads,
                                    CommonOption::simd, CommonOption::seed, CommonOption::set,
                                    CommonOption::json, CommonOption::quiet, CommonOption::resume,
                                    CommonOption::time_limit, CommonOption::checkpoint_every});
                return [arguments](const Invocation& invocation) {
                    return run(*arguments, invocation);
                };
            }};
}

}  // namespace spheroscope::cli
