#include "engine/cli/interrupt.hpp"
#include "engine/cli/json_output.hpp"
#include "engine/cli/log.hpp"
#include "engine/cli/options.hpp"
#include "engine/cli/report_output.hpp"
#include "engine/cli/version.hpp"
#include "render/verb_pictures.hpp"
#include "viewer/app.hpp"
#include "viewer/live_run.hpp"
#include "viewer/painter.hpp"
#include "viewer/stored_frames.hpp"
#include "viewer/verbs.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <exception>
#include <filesystem>
#include <memory>

namespace spheroscope {
namespace {

namespace fs = std::filesystem;

constexpr int k_width_px = 1720, k_height_px = 1012;

struct ViewArguments {
    std::string input;
    bool overwrite = false, paused = false;
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
                            {"dragged_s", report.dragged_s},
                            {"dragged_pictures", report.dragged_pictures},
                            {"longest_pick_s", report.longest_pick_s},
                            {"files", report.files},
                            {"copied", report.copied},
                            {"message", model.message},
                            {"contact", nullptr},
                            {"node", nullptr},
                            {"selection", nullptr}};
    if (model.opened)
        document[viewer::contact_of(model.opened) ? "contact" : "node"] =
            viewer::key_text(*model.opened);
    if (model.selection)
        document["selection"] = {{"cell", model.selection->cell},
                                 {"triangle", model.selection->triangle},
                                 {"node", model.selection->node},
                                 {"other_cell", model.selection->other_cell}};
    return document;
}

ExitCode view_file(const ViewArguments& arguments) {
    const cli::CommonOptions& common = arguments.common;
    if (arguments.overwrite || arguments.paused || common.threads > 0 || !common.simd.empty() ||
        common.seed)
        throw Error("--overwrite, --paused, --threads, --simd and --seed are about a scene that is "
                    "simulated, not about a run that is stored");
    const std::vector<scene::Picture> pictures =
        pictures_of(RunFileReader(arguments.input), common);
    const auto wake = [] { viewer::Window::wake(); };
    // While the window is being made the first frame is read, and the pictures' OpenGL gets ready.
    viewer::StoredFrames frames(arguments.input, wake);
    viewer::Painter painter(frames.header(), pictures.front(), wake);
    viewer::Window window("spheroscope: " + arguments.input, k_width_px, k_height_px);
    viewer::PanelModel model(pictures);
    model.bookmarks = viewer::read_bookmarks(viewer::bookmarks_path(arguments.input));
    viewer::AppSettings settings;
    settings.run_file = arguments.input;
    settings.folder =
        common.output.empty() ? fs::path(arguments.input).parent_path().string() : common.output;
    settings.drawn_by = cli::version_text();
    const viewer::AppReport report =
        viewer::run_app(window, frames, painter, model, nullptr, settings);
    if (common.json) cli::print_json(document_of(model, report));
    return ExitCode::ok;
}

/// Runs the scene and shows it meanwhile. A window that is closed ends the run with a checkpoint.
ExitCode view_scene(const ViewArguments& arguments, const cli::Invocation& invocation) {
    const cli::CommonOptions& common = arguments.common;
    const scene::Scene scene = scene::load_scene(arguments.input, common.overrides());
    cli::log_warnings(scene.warnings);
    if (scene.pictures.empty())
        throw Error(Loc{arguments.input, 0, 0}, "a view needs at least one [[picture]]",
                    "`run` simulates without pictures");
    const cli::RunPlace place = cli::run_place(arguments.input, common);
    if (!arguments.overwrite) cli::check_nothing_is_lost(place, scene, {});
    cli::CommonOptions quiet = common;
    quiet.quiet = true;  // the panel shows the progress
    viewer::Window window("spheroscope: " + arguments.input, k_width_px, k_height_px);
    viewer::LiveRun live(scene, place, quiet, {arguments.overwrite, arguments.paused}, invocation,
                         [] { viewer::Window::wake(); });
    viewer::Painter painter(live.header(), scene.pictures.front(), [] { viewer::Window::wake(); });
    if (arguments.paused) cli::log_info("the engine waits: Space plays, . makes one step");
    viewer::PanelModel model(scene.pictures);
    model.live.emplace();
    model.follow_engine();
    viewer::AppSettings settings;
    settings.run_file = place.run_file();
    settings.folder = place.folder;
    settings.drawn_by = cli::version_text();
    viewer::AppReport report;
    std::exception_ptr trouble;  // of the panel: what the run has come to is told first
    try {
        report = viewer::run_app(window, live, painter, model, &live, settings);
    } catch (...) {
        trouble = std::current_exception();
    }
    const cli::SimulationSummary summary = live.finish();
    const double pace = live.channel().pace().overall();
    if (common.json) {
        nlohmann::json document = document_of(model, report);
        document["run"] = cli::summary_json(summary, place);
        document["changes"] = changes_text(live.channel().changes());
        document["looks"] = live.looks().size();
        document["model_s_per_wall_s"] = cli::number_or_null(pace);
        cli::print_json(document);
    } else {
        fmt::print("{}model time           {:.3g} s in a second of wall time, pauses left out\n",
                   cli::summary_text(summary, place), pace);
    }
    if (!summary.result.message.empty()) cli::log_error(summary.result.message);
    if (trouble) std::rethrow_exception(trouble);
    const bool by_hand =
        summary.result.verdict == RunVerdict::stopped && cli::interrupt_signal() == 0;
    if (by_hand)
        cli::log_info(
            fmt::format("the window was closed; `run --resume` goes on with {}", place.run_file()));
    return by_hand ? ExitCode::ok : summary.code;
}

}  // namespace

cli::Verb view_verb() {
    return {"view", "shows a run in a window: of a file, or of a scene while it is simulated",
            [](cli::CommandLine& command) -> cli::VerbAction {
                using cli::CommonOption;
                const auto arguments = std::make_shared<ViewArguments>();
                command.argument("SCENE|FILE", arguments->input, "scene, or HDF5 file of a run");
                command.flag(
                    "--overwrite", arguments->overwrite,
                    "begin anew where a run is: unfinished, finished, or of another scene or seed");
                command.flag("--paused", arguments->paused,
                             "a scene begins in a pause: Space plays, . makes one step");
                cli::add_common_options(command, arguments->common,
                                        {CommonOption::output_folder, CommonOption::threads,
                                         CommonOption::simd, CommonOption::seed, CommonOption::set,
                                         CommonOption::json});
                return [arguments](const cli::Invocation& invocation) {
                    return is_run_file(arguments->input) ? view_file(*arguments)
                                                         : view_scene(*arguments, invocation);
                };
            }};
}

}  // namespace spheroscope
