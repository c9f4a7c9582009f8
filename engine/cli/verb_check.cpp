#include "engine/cli/json_output.hpp"
#include "engine/cli/options.hpp"
#include "engine/cli/verb.hpp"
#include "engine/scene/scene.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include <memory>
#include <optional>
#include <string>

namespace spheroscope::cli {
namespace {

/// How many cells the scene has; none when a file says it.
std::optional<int> n_cells(const scene::Cells& cells) {
    switch (cells.arrangement) {
    case scene::Arrangement::packing: return cells.count;
    case scene::Arrangement::single: return 1;
    case scene::Arrangement::pair: return 2;
    case scene::Arrangement::centres: return static_cast<int>(cells.centres_um.size());
    case scene::Arrangement::file: return std::nullopt;
    }
    return std::nullopt;
}

struct CheckArguments {
    std::string scene;
    bool print_config = false;
    CommonOptions common;
};

nlohmann::json describe(const scene::Scene& scene) {
    const std::optional<int> cells = n_cells(scene.cells);
    return {{"scene", scene.file},
            {"valid", true},
            {"title", scene.title},
            {"seed", scene.seed},
            {"cells", cells ? nlohmann::json(*cells) : nlohmann::json()},
            {"nodes_per_cell", scene.cells.nodes},
            {"stages", scene.stages.size()},
            {"warnings", scene.warnings},
            {"resolved", scene.resolved_toml}};
}

nlohmann::json describe(const std::string& path, const Error& error) {
    return {{"scene", path},
            {"valid", false},
            {"file", error.loc().file},
            {"line", error.loc().line},
            {"column", error.loc().column},
            {"error", error.what()}};
}

/// "scenes/a.toml: valid. A drop at rest: 1 cell, 642 nodes per cell, 1 stage"
std::string summary(const scene::Scene& scene) {
    const auto counted = [](std::size_t n, const char* thing) {
        return fmt::format("{} {}{}", n, thing, n == 1 ? "" : "s");
    };
    const std::optional<int> cells = n_cells(scene.cells);
    return fmt::format("{}: valid. {}: {}, {} nodes per cell, {}", scene.file, scene.title,
                       cells ? counted(static_cast<std::size_t>(*cells), "cell")
                             : "cells from " + scene.cells.file,
                       scene.cells.nodes, counted(scene.stages.size(), "stage"));
}

ExitCode check(const CheckArguments& arguments) {
    try {
        const scene::Scene scene = scene::load_scene(arguments.scene, arguments.common.overrides());
        if (arguments.common.json) {
            print_json(describe(scene));
            return ExitCode::ok;
        }
        for (const std::string& warning : scene.warnings) spdlog::warn("{}", warning);
        if (arguments.print_config)
            fmt::print("{}", scene.resolved_toml);
        else
            fmt::print("{}\n", summary(scene));
        return ExitCode::ok;
    } catch (const Error& error) {
        // whoever reads the JSON gets the verdict there, and the message on stderr like everybody
        if (arguments.common.json) print_json(describe(arguments.scene, error));
        throw;
    }
}

}  // namespace

Verb check_verb() {
    return {"check", "validates a scene without running it", [](CLI::App& command) -> VerbAction {
                const auto arguments = std::make_shared<CheckArguments>();
                command.add_option("SCENE", arguments->scene, "scene file")->required();
                command.add_flag("--print-config", arguments->print_config,
                                 "print the scene as resolved, with every default");
                add_common_options(command, arguments->common,
                                   {CommonOption::set, CommonOption::seed, CommonOption::json});
                return [arguments](const Invocation&) { return check(*arguments); };
            }};
}

}  // namespace spheroscope::cli
