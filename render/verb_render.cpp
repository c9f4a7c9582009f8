#include "engine/base/index.hpp"
#include "engine/cli/frame_choice.hpp"
#include "engine/cli/report_output.hpp"
#include "engine/cli/version.hpp"
#include "render/movie_painter.hpp"
#include "render/png.hpp"
#include "render/verb_pictures.hpp"
#include "render/verbs.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace spheroscope {
namespace {

namespace fs = std::filesystem;

struct RenderArguments {
    std::string file;
    std::string picture;
    std::optional<int> frame;  ///< none: the last one
    std::string frames;        ///< as given, "anneal,120,-1"; empty: one frame alone
    cli::CommonOptions common;
};

/// The frame of a number, from the end if it is negative, or the last one of a stage. Throws Error
/// with what there is.
int frame_of(const std::string& text, const std::vector<std::string>& stage_names) {
    const auto n = static_cast<int>(stage_names.size());
    for (int i = n; i-- > 0;)
        if (stage_names[static_cast<std::size_t>(i)] == text) return i;
    int frame = 0;
    const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), frame);
    if (failed == std::errc() && end == text.data() + text.size() && frame >= -n && frame < n)
        return frame < 0 ? n + frame : frame;
    std::vector<std::string> names;  // in the order of the run
    std::unique_copy(stage_names.begin(), stage_names.end(), std::back_inserter(names));
    throw Error(fmt::format("--frames wants frames or stages, got '{}'", text),
                fmt::format("frames are 0 to {} or from the end, stages {}", n - 1,
                            fmt::join(names, ", ")));
}

std::vector<std::string> parts_of(const std::string& list) {
    std::vector<std::string> parts(1);
    for (const char c : list)
        if (c == ',')
            parts.emplace_back();
        else
            parts.back() += c;
    return parts;
}

/// Wider pictures are not opened by many programs.
constexpr int k_widest_strip_px = 16384;

/// Several frames of a run beside each other, with one range and one scale.
void render_strip(render::FrameSource& run, scene::Picture picture, const std::string& list,
                  const fs::path& folder) {
    picture.plot.clear();  // a plot has one mark for each run, and this is one
    const render::Survey survey = render::survey_frames(run, picture);
    std::vector<render::MoviePainter::Shown> shown;
    const double widest_um =
        *std::max_element(survey.fit_radius_um.begin(), survey.fit_radius_um.end());
    const std::vector<std::string> parts = parts_of(list);
    const std::size_t n_most = idx(k_widest_strip_px / picture.size_px[0]);
    if (parts.size() > n_most)
        throw Error(fmt::format("--frames: {} pictures of {} px are wider than {} px", parts.size(),
                                picture.size_px[0], k_widest_strip_px),
                    fmt::format("{} have room at this size; --set 'picture[0].size=[WIDTH, "
                                "HEIGHT]' makes them smaller",
                                n_most));
    for (const std::string& part : parts) {
        render::MoviePainter::Shown one;
        one.frame = frame_of(part, survey.stage_names);
        one.view.fit_radius_um = widest_um;
        if (picture.range != "frame") one.view.range = survey.range;
        one.view.time_decimals = survey.time_decimals;
        shown.push_back(one);
    }
    const std::vector<render::FrameSource*> runs(shown.size(), &run);
    render::MoviePainter painter(runs, std::vector<render::Survey>(shown.size(), survey), picture,
                                 cli::version_text());
    const render::Image image = painter.paint(shown);
    render::PngTexts texts = painter.texts(shown);
    texts[render::k_drawn_with_key] = painter.drawn_with();
    const fs::path path = folder / (picture.name + "_strip.png");
    render::write_png(path, image, texts);
    fmt::print("{}\n", path.string());
}

ExitCode render_stills(const RenderArguments& arguments) {
    if (arguments.frame && !arguments.frames.empty())
        throw Error("--frame and --frames exclude each other", "each of them says what is drawn");
    const RunFileReader reader(arguments.file);
    const int n_frames = reader.n_frames();
    const int frame = cli::FrameChoice{arguments.frame, ""}.number(reader);
    const fs::path beside = fs::path(arguments.file).parent_path();
    const fs::path folder =
        cli::report_folder(arguments.common, beside.empty() ? "." : beside.string());
    StoredFrames frames(reader);
    for (const scene::Picture& picture :
         choose(pictures_of(reader, arguments.common), arguments.picture)) {
        if (!arguments.frames.empty()) {
            render_strip(frames, picture, arguments.frames, folder);
            continue;
        }
        // A still has the range and the scale that it has in the movie.
        const render::Survey survey = render::survey_frames(frames, picture);
        render::FrameSource* const runs[]{&frames};
        render::MoviePainter painter(runs, std::span(&survey, 1), picture, cli::version_text());
        render::MoviePainter::Shown shown;
        shown.frame = frame;
        shown.view.fit_radius_um = survey.fit_radius_um[static_cast<std::size_t>(frame)];
        if (picture.range != "frame") shown.view.range = survey.range;
        shown.view.progress = n_frames > 1 ? static_cast<double>(frame) / (n_frames - 1) : 0.0;
        shown.view.time_decimals = survey.time_decimals;
        const fs::path path = folder / fmt::format("{}_{:06d}.png", picture.name, frame);
        const std::span<const render::MoviePainter::Shown> all(&shown, 1);
        const render::Image image = painter.paint(all);
        render::PngTexts texts = painter.texts(all);
        texts[render::k_drawn_with_key] = painter.drawn_with();
        render::write_png(path, image, texts);
        fmt::print("{}\n", path.string());
    }
    return ExitCode::ok;
}

}  // namespace

cli::Verb render_verb() {
    return {"render", "draws stills of one frame of a run's file",
            [](cli::CommandLine& command) -> cli::VerbAction {
                using cli::CommonOption;
                const auto arguments = std::make_shared<RenderArguments>();
                command.argument("FILE", arguments->file, "HDF5 file of a run");
                command.option("--frame", arguments->frame, "frame; -1 is the last");
                command.option("--frames", arguments->frames,
                               "several beside each other in one picture: frames, or stages for "
                               "their last ones; anneal,compact,indent",
                               {.type = "LIST"});
                command.option("--picture", arguments->picture,
                               "name of a [[picture]], or 'all'; default: the first");
                cli::add_common_options(command, arguments->common,
                                        {CommonOption::output_folder, CommonOption::set});
                return [arguments](const cli::Invocation&) { return render_stills(*arguments); };
            }};
}

}  // namespace spheroscope
