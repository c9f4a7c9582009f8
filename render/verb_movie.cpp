#include "engine/base/counted.hpp"
#include "engine/cli/interrupt.hpp"
#include "engine/cli/json_output.hpp"
#include "engine/cli/log.hpp"
#include "engine/cli/progress.hpp"
#include "engine/cli/report_output.hpp"
#include "engine/cli/simulate.hpp"
#include "engine/cli/version.hpp"
#include "render/image_diff.hpp"
#include "render/movie.hpp"
#include "render/movie_painter.hpp"
#include "render/png.hpp"
#include "render/provenance.hpp"
#include "render/verb_pictures.hpp"
#include "render/verbs.hpp"
#include "render/verify.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace spheroscope {
namespace {

namespace fs = std::filesystem;

struct MovieArguments {
    std::string input;
    std::string picture;
    std::string compare;  ///< file of the run beside it
    std::string verify;   ///< picture to draw again
    bool no_png = false;
    bool overwrite = false;
    cli::CommonOptions common;
};

/// A run of exactly this scene, with nothing changed on the way, that came to its end.
bool has_finished_run(const cli::RunPlace& place, const scene::Scene& scene) {
    if (!fs::exists(place.run_file())) return false;
    try {
        const RunFileReader reader(place.run_file());
        return reader.is_complete() && reader.changes().empty() &&
               cli::is_made_by_this_program(*reader.header()) &&
               cli::is_run_of(scene, *reader.header());
    } catch (const Error&) {
        return false;  // whatever is there is not this run; simulate() says what it thinks of it
    }
}

struct MovieOutcome {
    ExitCode code = ExitCode::ok;
    nlohmann::json document;
    std::string text;
};

ExitCode interrupted() { return cli::code_after_signal(ExitCode::interrupted); }

/// Draws the wanted pictures of a run's file into `folder`.
void draw(const RunFileReader& reader, const std::vector<scene::Picture>& pictures,
          const fs::path& folder, const MovieArguments& arguments, MovieOutcome& outcome) {
    const cli::InterruptGuard interrupts;
    cli::Progress progress(cli::progress_style(arguments.common.quiet));
    StoredFrames frames(reader);
    std::optional<RunFileReader> other_reader;
    std::optional<StoredFrames> other;
    if (!arguments.compare.empty()) {
        other_reader.emplace(arguments.compare);
        other.emplace(*other_reader);
    }
    for (const scene::Picture& picture : pictures) {
        const auto begin = std::chrono::steady_clock::now();
        render::MovieSettings settings;
        settings.picture = picture;
        const std::string name = picture.name + (other ? "_compared" : "");
        settings.frames_folder = folder / "frames" / name;
        settings.movie_path = folder / (name + ".mp4");
        settings.keeps_pictures = !arguments.no_png;
        settings.drawn_by = cli::version_text();
        settings.on_progress = [&](int n_done, int n_frames) {
            constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
            progress.update({"pictures", static_cast<double>(n_done) / n_frames, unknown, unknown});
        };
        settings.stop_requested = [&] { return interrupts.stop().load(); };
        const render::MovieResult result = other ? render::make_comparison(frames, *other, settings)
                                                 : render::make_movie(frames, settings);
        progress.clear();
        for (const std::string& remark : result.remarks) cli::log_warning(remark);
        const double wall_s =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        outcome.document["movies"].push_back(
            {{"picture", picture.name},
             {"movie",
              result.stopped ? nlohmann::json() : nlohmann::json(settings.movie_path.string())},
             {"frames_folder", arguments.no_png ? "" : settings.frames_folder.string()},
             {"frames", result.n_frames},
             {"done", result.n_done},
             {"drawn", result.n_drawn},
             {"stopped", result.stopped},
             {"share_outside_range", result.share_outside},
             {"remarks", result.remarks},
             {"wall_s", wall_s}});
        if (!result.stopped)
            outcome.text += fmt::format(
                "movie                {} ({}, {} drawn, {})\n", settings.movie_path.string(),
                counted(result.n_frames, "frame"), result.n_drawn, cli::duration_text(wall_s));
        if (result.stopped) {
            outcome.text += fmt::format("movie                none: stopped after {} of {}\n",
                                        result.n_done, counted(result.n_frames, "picture"));
            outcome.code = interrupted();
            return;
        }
    }
}

/// A folder that is gone at the end.
class ScratchFolder {
  public:
    ScratchFolder() {
        std::string name = (fs::temp_directory_path() / "spheroscope-XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr)
            throw Error("no folder can be made in " + fs::temp_directory_path().string(), "",
                        ExitCode::environment);
        path_ = name;
    }
    ~ScratchFolder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    [[nodiscard]] const fs::path& path() const { return path_; }

  private:
    fs::path path_;
};

/// The run that a picture was drawn from: beside a still, or two folders above a movie's picture.
std::string run_of_picture(const fs::path& picture) {
    const fs::path folder = fs::absolute(picture).parent_path();
    for (const fs::path& candidate :
         {folder / "run.h5", folder.parent_path().parent_path() / "run.h5"})
        if (fs::exists(candidate)) return candidate.string();
    return "";
}

/// Whether the n parts of a picture are frames of one run, as far as its file says.
bool is_strip_of_one_run(const render::PngTexts& texts, int n_shown) {
    std::string prefix;
    for (int k = 1; k < n_shown; ++k) {
        prefix += render::MoviePainter::k_beside;
        for (const std::string key : {"Scene", "Seed"}) {
            const auto first = texts.find(key), other = texts.find(prefix + key);
            if (first == texts.end() || other == texts.end() || first->second != other->second)
                return false;
        }
    }
    return true;
}

/// Simulates a picture's scene anew, with what was changed on the way to it.
cli::SimulationSummary simulate_scene_of(const render::PngTexts& texts, const cli::RunPlace& place,
                                         const MovieArguments& arguments,
                                         const cli::Invocation& invocation) {
    if (!texts.contains("Scene"))
        throw Error(arguments.verify + ": the picture does not carry its scene",
                    "pictures of movie and render do, unless another program has saved them anew");
    cli::log_info("no run beside the picture: its own scene is simulated anew");
    const auto name = texts.find("Scene name");
    const scene::Scene scene =
        scene::parse_scene(texts.at("Scene"), name == texts.end() ? "scene" : name->second);
    cli::refuse_cells_beside_a_scene(scene, arguments.verify, "name the run's file as well");
    std::vector<Change> changes;
    if (const auto text = texts.find(render::k_changes_key); text != texts.end())
        changes = parse_changes(text->second, arguments.verify);
    const cli::SimulationSummary summary =
        cli::simulate(scene, place, arguments.common, false, invocation, changes);
    if (!summary.result.message.empty()) cli::log_error(summary.result.message);
    return summary;
}

/// Draws a picture again from what its file says, of a run that is there or is simulated anew.
ExitCode verify(const MovieArguments& arguments, const cli::Invocation& invocation) {
    cli::refuse_own_input(arguments.common.output, arguments.verify);
    const render::PngFile file = render::read_png(arguments.verify);
    const int n_shown = render::n_shown(file.texts);
    if (arguments.compare.empty() && !is_strip_of_one_run(file.texts, n_shown))
        throw Error(arguments.verify + " shows two runs side by side",
                    "name the other one with --compare");
    if (!arguments.compare.empty() && n_shown != 2)
        throw Error(
            fmt::format("{} shows {} of one run", arguments.verify, counted(n_shown, "frame")),
            "leave --compare out");
    std::string run_file =
        arguments.input.empty() ? run_of_picture(arguments.verify) : arguments.input;
    std::optional<ScratchFolder> scratch;
    if (run_file.empty()) {
        scratch.emplace();
        const cli::RunPlace place{scratch->path().string()};
        const cli::SimulationSummary summary =
            simulate_scene_of(file.texts, place, arguments, invocation);
        if (summary.code == ExitCode::interrupted || summary.code == ExitCode::terminated)
            return summary.code;
        run_file = place.run_file();
    }
    const RunFileReader reader(run_file);
    StoredFrames frames(reader);
    std::vector<render::FrameSource*> runs(static_cast<std::size_t>(n_shown), &frames);
    std::optional<RunFileReader> other_reader;
    std::optional<StoredFrames> other;
    if (!arguments.compare.empty()) {
        other_reader.emplace(arguments.compare);
        other.emplace(*other_reader);
        runs[1] = &*other;
    }
    const render::Verification result = render::verify_picture(file, runs, cli::version_text());
    const bool verified = result.reasons.empty();
    if (!arguments.common.output.empty())
        render::write_png(arguments.common.output,
                          render::difference_sheet(file.image, result.drawn));
    if (arguments.common.json) {
        cli::print_json(
            {{"verified", verified},
             {"reasons", result.reasons},
             {"run", scratch ? nlohmann::json() : nlohmann::json(run_file)},
             {"frame", result.frame},
             {"every_bit_counts", result.is_same_machine},
             {"max_difference", result.difference.max_difference},
             {"share_over_threshold_shifted", result.difference.share_over_threshold_shifted},
             {"similarity", result.difference.similarity}});
    } else {
        fmt::print("{}: frame {} of {}, {}\n", verified ? "verified" : "different", result.frame,
                   scratch ? "its scene, simulated anew" : run_file,
                   result.is_same_machine ? "every bit compared"
                                          : "drawn by another program or machine, so compared with "
                                            "a tolerance");
        for (const std::string& reason : result.reasons) fmt::print("  {}\n", reason);
    }
    return verified ? ExitCode::ok : ExitCode::differs;
}

/// Options of a simulation, or of pictures, are not ignored where there is none to be made.
void refuse_idle_options(const MovieArguments& arguments) {
    const cli::CommonOptions& common = arguments.common;
    const auto refuse = [](bool is_given, const std::string& option, const std::string& where) {
        if (is_given) throw Error(option + " means nothing " + where, "leave it out");
    };
    const bool verifies = !arguments.verify.empty();
    const std::string where = verifies ? "with --verify" : "to a run that is there";
    if (verifies || is_run_file(arguments.input)) {
        refuse(!common.time_limit.empty(), "--time-limit", where);
        refuse(!common.checkpoint_every.empty(), "--checkpoint-every", where);
        refuse(common.resume, "--resume", where);
        refuse(arguments.overwrite, "--overwrite", where);
    }
    if (!verifies) return;
    refuse(!arguments.picture.empty(), "--picture", where);
    refuse(arguments.no_png, "--no-png", where);
    refuse(!common.overrides().empty(), common.seed ? "--seed" : "--set", where);
}

/// What a movie is made of.
struct MovieInput {
    std::string run_file;
    fs::path folder;
    std::vector<scene::Picture> pictures;
    bool is_drawn = true;  ///< a run that will go on later has no movie yet
};

MovieInput input_of_run(const MovieArguments& arguments) {
    return {
        arguments.input,
        arguments.common.output.empty() ? fs::path(arguments.input).parent_path()
                                        : fs::path(arguments.common.output),
        choose(pictures_of(RunFileReader(arguments.input), arguments.common), arguments.picture)};
}

/// Simulates the scene, unless its run is there.
MovieInput input_of_scene(const MovieArguments& arguments, const cli::Invocation& invocation,
                          MovieOutcome& outcome) {
    const scene::Scene scene = scene::load_scene(arguments.input, arguments.common.overrides());
    cli::log_warnings(scene.warnings);
    if (scene.pictures.empty())
        throw Error(Loc{arguments.input, 0, 0}, "a movie needs at least one [[picture]]",
                    "`run` simulates without pictures");
    const cli::RunPlace place = cli::run_place(arguments.input, arguments.common);
    MovieInput input{place.run_file(), place.folder, choose(scene.pictures, arguments.picture)};
    if (!arguments.overwrite && has_finished_run(place, scene)) {
        cli::log_info(fmt::format("{} holds this run already", input.run_file));
        return input;
    }
    const cli::SimulationSummary summary =
        cli::simulate(scene, place, arguments.common, arguments.overwrite, invocation);
    outcome.code = summary.code;
    outcome.document["run"] = cli::summary_json(summary, place);
    outcome.text += cli::summary_text(summary, place);
    if (!summary.result.message.empty()) cli::log_error(summary.result.message);
    // One that became unstable has a movie, too.
    const RunVerdict verdict = summary.result.verdict;
    input.is_drawn = verdict == RunVerdict::finished || verdict == RunVerdict::cap ||
                     verdict == RunVerdict::unstable;
    return input;
}

/// Mistakes that are better told before a simulation than after it.
void refuse_early(const MovieArguments& arguments) {
    if (arguments.input.empty())
        throw Error("movie wants a scene or a run's file, got none",
                    "spheroscope movie --help lists what it takes");
    if (!arguments.common.output.empty())
        if (const std::string problem = cli::problem_of_folder(arguments.common.output);
            !problem.empty())
            throw Error("-o: " + problem, "with --verify it is the file of a sheet");
    if (!arguments.compare.empty()) static_cast<void>(RunFileReader(arguments.compare));
}

ExitCode movie(const MovieArguments& arguments, const cli::Invocation& invocation) {
    refuse_idle_options(arguments);
    if (!arguments.verify.empty()) return verify(arguments, invocation);
    refuse_early(arguments);
    MovieOutcome outcome;
    outcome.document["movies"] = nlohmann::json::array();
    const bool is_of_run = is_run_file(arguments.input);
    const MovieInput input =
        is_of_run ? input_of_run(arguments) : input_of_scene(arguments, invocation, outcome);
    std::exception_ptr trouble;
    if (input.is_drawn) {
        try {
            const RunFileReader reader(input.run_file);
            if (reader.n_frames() > 0)
                draw(reader, input.pictures, input.folder, arguments, outcome);
            else if (is_of_run)
                throw Error(input.run_file + ": there is no frame to make a movie of",
                            "the run has no frames yet");
        } catch (...) {
            // What the run has come to, and movies that are there, are told first.
            if (outcome.text.empty()) throw;
            trouble = std::current_exception();
        }
    }
    if (arguments.common.json)
        cli::print_json(outcome.document);
    else
        fmt::print("{}", outcome.text);
    if (trouble) std::rethrow_exception(trouble);
    return outcome.code;
}

}  // namespace

cli::Verb movie_verb() {
    return {
        "movie", "makes a stress-map movie of a scene or of a run's file",
        [](cli::CommandLine& command) -> cli::VerbAction {
            using cli::CommonOption;
            const auto arguments = std::make_shared<MovieArguments>();
            command.optional_argument("SCENE|FILE", arguments->input,
                                      "scene, or HDF5 file of a run (with --verify: that run; "
                                      "default: the one beside the picture, else its scene is "
                                      "simulated anew)");
            command.option("--picture", arguments->picture,
                           "name of a [[picture]], or 'all'; default: the first");
            command.option("--compare", arguments->compare,
                           "HDF5 file of another run, shown beside this one with one range "
                           "and one scale",
                           {"OTHER"});
            command.option("--verify", arguments->verify,
                           "draw this picture again from what its file says and compare; exit "
                           "code 4 if it differs, -o writes a sheet",
                           {"FRAME.png"});
            command.flag("--no-png", arguments->no_png, "the MP4 only, no pictures");
            command.flag("--overwrite", arguments->overwrite, "simulate anew, also where a run is");
            cli::add_common_options(command, arguments->common,
                                    {CommonOption::output, CommonOption::threads,
                                     CommonOption::simd, CommonOption::seed, CommonOption::set,
                                     CommonOption::json, CommonOption::quiet, CommonOption::resume,
                                     CommonOption::time_limit, CommonOption::checkpoint_every});
            return [arguments](const cli::Invocation& invocation) {
                return movie(*arguments, invocation);
            };
        }};
}

}  // namespace spheroscope
