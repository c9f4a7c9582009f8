#include "engine/cli/json_output.hpp"
#include "engine/cli/simulate.hpp"
#include "engine/cli/verb.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include <memory>

namespace spheroscope::cli {
namespace {

struct RunArguments {
    std::string scene;
    bool overwrite = false;
    CommonOptions common;
};

ExitCode run(const RunArguments& arguments, const Invocation& invocation) {
    const scene::Scene scene = scene::load_scene(arguments.scene, arguments.common.overrides());
    for (const std::string& warning : scene.warnings) spdlog::warn("{}", warning);
    const RunPlace place = run_place(arguments.scene, arguments.common);
    const SimulationSummary summary =
        simulate(scene, place, arguments.common, arguments.overwrite, invocation);
    if (arguments.common.json)
        print_json(summary_json(summary, place));
    else
        fmt::print("{}", summary_text(summary, place));
    if (!summary.result.message.empty()) spdlog::error("{}", summary.result.message);
    return summary.code;
}

}  // namespace

Verb run_verb() {
    return {"run", "simulates a scene into an HDF5 file", [](CommandLine& command) -> VerbAction {
                const auto arguments = std::make_shared<RunArguments>();
                command.argument("SCENE", arguments->scene, "scene file");
                command.flag("--overwrite", arguments->overwrite,
                             "begin anew where an unfinished run is");
                add_common_options(command, arguments->common,
                                   {CommonOption::output, CommonOption::threads, CommonOption::simd,
                                    CommonOption::seed, CommonOption::set, CommonOption::json,
                                    CommonOption::quiet, CommonOption::resume,
                                    CommonOption::time_limit, CommonOption::checkpoint_every});
                return [arguments](const Invocation& invocation) {
                    return run(*arguments, invocation);
                };
            }};
}

}  // namespace spheroscope::cli
