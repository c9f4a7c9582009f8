#include "engine/base/counted.hpp"
#include "engine/cli/json_output.hpp"
#include "engine/cli/log.hpp"
#include "engine/cli/options.hpp"
#include "engine/cli/simulate.hpp"
#include "engine/cli/verb.hpp"
#include "engine/run/expectations.hpp"
#include "engine/scene/key_text.hpp"
#include "engine/scene/scene.hpp"
#include "engine/stages/build.hpp"
#include "engine/stages/choices.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

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
    bool explain = false;
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

nlohmann::json describe(const std::vector<PlanRow>& plan) {
    nlohmann::json rows = nlohmann::json::array();
    for (const PlanRow& row : plan)
        rows.push_back({{"part", row.part},
                        {"equation", row.equation},
                        {"in", row.is_in},
                        {"because", row.because}});
    return rows;
}

/// The plan as a table:
///
///     part              equation     run  because
///     cortex.elastic    (8)          in   scenes/a.toml:14:1
///     cortex.bending    (9), (10)    -    no [cortex.bending]
std::string table_text(const std::vector<PlanRow>& plan) {
    std::size_t part_width = 4, equation_width = 8;
    for (const PlanRow& row : plan) {
        part_width = std::max(part_width, row.part.size());
        equation_width = std::max(equation_width, row.equation.size());
    }
    const auto line = [&](const std::string& part, const std::string& equation,
                          const std::string& in, const std::string& because) {
        return fmt::format("{:<{}}  {:<{}}  {:<3}  {}\n", part, part_width, equation,
                           equation_width, in, because);
    };
    std::string text = line("part", "equation", "run", "because");
    for (const PlanRow& row : plan)
        text += line(row.part, row.equation, row.is_in ? "in" : "-", row.because);
    return text;
}

nlohmann::json describe(const std::string& path, const Error& error) {
    return {{"scene", path},
            {"valid", false},
            {"file", error.loc().file},
            {"line", error.loc().line},
            {"column", error.loc().column},
            {"error", error.what()}};
}

/// What the scene has chosen where the paper leaves a choice, whether it says so or not, and what
/// adhesion that gives; "" without contacts.
std::string contact_choices(const scene::Scene& scene) {
    if (!scene.contact) return "";
    scene::Draft draft;
    draft.scene = scene;
    std::string text = "  contact:";
    for (const scene::Key& key : scene::all_keys()) {
        // Whether a key applies is asked of the scene: there is no file behind this draft.
        const bool is_choice =
            key.table == "contact" &&
            (key.name == "law" ||
             (key.name == "reject_cos" && scene.contact->law == scene::ContactLaw::traction) ||
             (key.name == "omega_reading" && scene.contact->adhesive));
        if (is_choice) text += fmt::format(" {} = {},", key.name, scene::value_text(draft, key, 0));
    }
    return text + fmt::format(" W = {:.4g} nN/um\n", scene.contact->W_nN_per_um);
}

/// "scenes/a.toml: valid. A drop at rest: 1 cell, 642 nodes per cell, 1 stage"
std::string summary(const scene::Scene& scene) {
    const std::optional<int> cells = n_cells(scene.cells);
    return fmt::format("{}: valid. {}: {}, {} nodes per cell, {}", scene.file, scene.title,
                       cells ? counted(*cells, "cell") : "cells from " + scene.cells.file,
                       scene.cells.nodes, counted(scene.stages.size(), "stage"));
}

ExitCode check(const CheckArguments& arguments) {
    try {
        const scene::Scene scene = scene::load_scene(arguments.scene, arguments.common.overrides());
        // What only the engine's tables know is checked here too: a valid scene is one that runs.
        static_cast<void>(chosen_method(scene));
        static_cast<void>(chosen_fields(scene));
        check_expectation_names(scene);
        check_centres(scene);
        if (const std::optional<GivenCells> given = given_cells(scene))
            static_cast<void>(Engine(scene, {}, given));
        if (arguments.common.json) {
            nlohmann::json document = describe(scene);
            if (arguments.explain) document["plan"] = describe(explain(scene));
            print_json(document);
            return ExitCode::ok;
        }
        log_warnings(scene.warnings);
        if (arguments.print_config)
            fmt::print("{}", scene.resolved_toml);
        else if (arguments.explain)
            fmt::print("{}", table_text(explain(scene)));
        else
            fmt::print("{}\n{}", summary(scene), contact_choices(scene));
        return ExitCode::ok;
    } catch (const Error& error) {
        // whoever reads the JSON gets the verdict there, and the message on stderr like everybody
        if (arguments.common.json) print_json(describe(arguments.scene, error));
        throw;
    }
}

}  // namespace

Verb check_verb() {
    return {"check", "validates a scene without running it",
            [](CommandLine& command) -> VerbAction {
                const auto arguments = std::make_shared<CheckArguments>();
                command.argument("SCENE", arguments->scene, "scene file");
                command.flag("--print-config", arguments->print_config,
                             "print the scene as resolved, with every default");
                command.flag("--explain", arguments->explain,
                             "list what is in the run and what is not, and because of which "
                             "line of the scene");
                add_common_options(command, arguments->common,
                                   {CommonOption::set, CommonOption::seed, CommonOption::json});
                return [arguments](const Invocation&) { return check(*arguments); };
            }};
}

}  // namespace spheroscope::cli
