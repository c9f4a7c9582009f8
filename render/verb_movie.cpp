#include "engine/cli/interrupt.hpp"
#include "engine/cli/json_output.hpp"
#include "engine/cli/progress.hpp"
#include "engine/cli/simulate.hpp"
#include "engine/cli/version.hpp"
#include "render/movie.hpp"
#include "render/verb_pictures.hpp"
#include "render/verbs.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include <chrono>
#include <filesystem>
#include <limits>
#include <memory>

namespace spheroscope {
namespace {

namespace fs = std::filesystem;

struct MovieArguments {
    std::string input;
    std::string picture;
    bool overwrite = false;
    cli::CommonOptions common;
};

/// A run of exactly this scene that came to its end.
bool has_finished_run(const cli::RunPlace& place, const scene::Scene& scene) {
    if (!fs::exists(place.run_file())) return false;
    try {
        const RunFileReader reader(place.run_file());
        // Only what the engine reads counts: other pictures of the same run need no new run.
        const scene::Scene stored = scene::parse_scene(reader.header()->resolved_scene, "stored");
        const auto physics = [](const std::string& text) {
            return text.substr(0, text.find("[[picture]]"));
        };
        return reader.is_complete() && reader.header()->version == cli::version_text() &&
               physics(stored.resolved_toml) == physics(scene.resolved_toml);
    } catch (const Error&) {
        return false;  // whatever is there is not this run; simulate() says what it thinks of it
    }
}

struct MovieOutcome {
    ExitCode code = ExitCode::ok;
    nlohmann::json document;
    std::string text;
};

ExitCode interrupted() {
    return cli::interrupt_signal() == SIGTERM ? ExitCode::terminated : ExitCode::interrupted;
}

/// Draws the wanted pictures of a run's file into `folder`.
void draw(const RunFileReader& reader, const std::vector<scene::Picture>& pictures,
          const fs::path& folder, bool quiet, MovieOutcome& outcome) {
    const cli::InterruptGuard interrupts;
    cli::Progress progress(cli::progress_style(quiet));
    StoredFrames frames(reader);
    for (const scene::Picture& picture : pictures) {
        const auto begin = std::chrono::steady_clock::now();
        render::MovieSettings settings;
        settings.picture = picture;
        settings.frames_folder = folder / "frames" / picture.name;
        settings.movie_path = folder / (picture.name + ".mp4");
        settings.drawn_by = cli::version_text();
        settings.on_progress = [&](int n_done, int n_frames) {
            constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
            progress.update({"pictures", static_cast<double>(n_done) / n_frames, unknown, unknown});
        };
        settings.stop_requested = [&] { return interrupts.stop().load(); };
        const render::MovieResult result = render::make_movie(frames, settings);
        progress.clear();
        const double wall_s =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        outcome.document["movies"].push_back({{"picture", picture.name},
                                              {"movie", settings.movie_path.string()},
                                              {"frames_folder", settings.frames_folder.string()},
                                              {"frames", result.n_frames},
                                              {"drawn", result.n_drawn},
                                              {"stopped", result.stopped},
                                              {"share_outside_range", result.share_outside},
                                              {"wall_s", wall_s}});
        outcome.text += fmt::format("movie                {} ({} frames, {} drawn, {})\n",
                                    settings.movie_path.string(), result.n_frames, result.n_drawn,
                                    cli::duration_text(wall_s));
        if (result.stopped) {
            outcome.code = interrupted();
            return;
        }
    }
}

ExitCode movie(const MovieArguments& arguments, const cli::Invocation& invocation) {
    MovieOutcome outcome;
    outcome.document["movies"] = nlohmann::json::array();
    std::string run_file = arguments.input;
    fs::path folder;
    std::vector<scene::Picture> pictures;
    bool is_drawn = true;
    if (is_run_file(arguments.input)) {
        folder = arguments.common.output.empty() ? fs::path(arguments.input).parent_path()
                                                 : fs::path(arguments.common.output);
        pictures =
            choose(pictures_of(RunFileReader(run_file), arguments.common), arguments.picture);
    } else {
        const scene::Scene scene = scene::load_scene(arguments.input, arguments.common.overrides());
        for (const std::string& warning : scene.warnings) spdlog::warn("{}", warning);
        if (scene.pictures.empty())
            throw Error(Loc{arguments.input, 0, 0}, "a movie needs at least one [[picture]]",
                        "`run` simulates without pictures");
        pictures = choose(scene.pictures, arguments.picture);
        const cli::RunPlace place = cli::run_place(arguments.input, arguments.common);
        folder = place.folder;
        run_file = place.run_file();
        if (!arguments.overwrite && has_finished_run(place, scene)) {
            spdlog::info("{} holds this run already", run_file);
        } else {
            const cli::SimulationSummary summary =
                cli::simulate(scene, place, arguments.common, arguments.overwrite, invocation);
            outcome.code = summary.code;
            outcome.document["run"] = cli::summary_json(summary, place);
            outcome.text += cli::summary_text(summary, place);
            if (!summary.result.message.empty()) spdlog::error("{}", summary.result.message);
            // A run that will go on later has no movie yet; one that became unstable has.
            const RunVerdict verdict = summary.result.verdict;
            is_drawn = verdict == RunVerdict::finished || verdict == RunVerdict::cap ||
                       verdict == RunVerdict::unstable;
        }
    }
    if (is_drawn) {
        const RunFileReader reader(run_file);
        if (reader.n_frames() > 0) draw(reader, pictures, folder, arguments.common.quiet, outcome);
    }
    if (arguments.common.json)
        cli::print_json(outcome.document);
    else
        fmt::print("{}", outcome.text);
    return outcome.code;
}

}  // namespace

cli::Verb movie_verb() {
    return {"movie", "makes a stress-map movie of a scene or of a run's file",
            [](CLI::App& command) -> cli::VerbAction {
                using cli::CommonOption;
                const auto arguments = std::make_shared<MovieArguments>();
                command.add_option("SCENE|FILE", arguments->input, "scene, or HDF5 file of a run")
                    ->required();
                command.add_option("--picture", arguments->picture,
                                   "name of a [[picture]], or 'all'; default: the first");
                command.add_flag("--overwrite", arguments->overwrite,
                                 "simulate anew, also where a run is");
                cli::add_common_options(command, arguments->common,
                                        {CommonOption::output, CommonOption::threads,
                                         CommonOption::simd, CommonOption::seed, CommonOption::set,
                                         CommonOption::json, CommonOption::quiet,
                                         CommonOption::resume, CommonOption::time_limit,
                                         CommonOption::checkpoint_every});
                return [arguments](const cli::Invocation& invocation) {
                    return movie(*arguments, invocation);
                };
            }};
}

}  // namespace spheroscope
