#include "engine/cli/json_output.hpp"
#include "engine/cli/options.hpp"
#include "engine/cli/version.hpp"
#include "render/verb_pictures.hpp"
#include "viewer/app.hpp"
#include "viewer/stored_frames.hpp"
#include "viewer/verbs.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include <filesystem>
#include <memory>

namespace spheroscope {
namespace {

namespace fs = std::filesystem;

constexpr int k_width_px = 1720, k_height_px = 1012;

struct ViewArguments {
    std::string input;
    cli::CommonOptions common;
};

/// Where the session ended: for scripts.
nlohmann::json document_of(const viewer::PanelModel& model, const viewer::AppReport& report) {
    nlohmann::json document{{"frame", model.playback.frame()},
                            {"frames", model.playback.n_frames()},
                            {"view", viewer::view_text(model.view.now())},
                            {"first_picture_s", report.first_picture_s},
                            {"draft_s", report.draft_s},
                            {"full_s", report.full_s},
                            {"longest_pick_s", report.longest_pick_s},
                            {"files", report.files},
                            {"copied", report.copied},
                            {"selection", nullptr}};
    if (model.selection)
        document["selection"] = {{"cell", model.selection->cell},
                                 {"triangle", model.selection->triangle},
                                 {"node", model.selection->node},
                                 {"other_cell", model.selection->other_cell}};
    return document;
}

ExitCode view_file(const ViewArguments& arguments) {
    const cli::CommonOptions& common = arguments.common;
    const std::vector<scene::Picture> pictures =
        pictures_of(RunFileReader(arguments.input), common);
    viewer::Window window("spheroscope: " + arguments.input, k_width_px, k_height_px);
    viewer::StoredFrames frames(arguments.input, [] { viewer::Window::wake(); });
    viewer::PanelModel model(pictures);
    model.bookmarks = viewer::read_bookmarks(viewer::bookmarks_path(arguments.input));
    viewer::AppSettings settings;
    settings.run_file = arguments.input;
    settings.folder =
        common.output.empty() ? fs::path(arguments.input).parent_path().string() : common.output;
    settings.drawn_by = cli::version_text();
    const viewer::AppReport report = viewer::run_app(window, frames, model, settings);
    if (common.json) cli::print_json(document_of(model, report));
    return ExitCode::ok;
}

}  // namespace

cli::Verb view_verb() {
    return {"view", "shows a run in a window, frame by frame",
            [](cli::CommandLine& command) -> cli::VerbAction {
                using cli::CommonOption;
                const auto arguments = std::make_shared<ViewArguments>();
                command.argument("FILE", arguments->input, "HDF5 file of a run");
                cli::add_common_options(
                    command, arguments->common,
                    {CommonOption::output, CommonOption::set, CommonOption::json});
                return [arguments](const cli::Invocation&) { return view_file(*arguments); };
            }};
}

}  // namespace spheroscope
