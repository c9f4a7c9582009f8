#include "engine/base/make_folder.hpp"
#include "engine/cli/frame_choice.hpp"
#include "engine/cli/report_output.hpp"
#include "engine/cli/version.hpp"
#include "render/movie_painter.hpp"
#include "render/png.hpp"
#include "render/verb_pictures.hpp"
#include "render/verb_strip.hpp"
#include "render/verbs.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>

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

ExitCode render_stills(const RenderArguments& arguments, const cli::Invocation& invocation) {
    if (arguments.frame && !arguments.frames.empty())
        throw Error("--frame and --frames exclude each other", "each of them says what is drawn");
    const RunFileReader reader(arguments.file);
    const int n_frames = reader.n_frames();
    const int frame = cli::FrameChoice{arguments.frame, ""}.number(reader);
    const fs::path beside = fs::path(arguments.file).parent_path();
    const fs::path folder =
        cli::report_place(arguments.common, beside.empty() ? "." : beside.string());
    StoredFrames frames(reader);
    for (const scene::Picture& picture :
         choose(pictures_of(reader, arguments.common), arguments.picture)) {
        if (!arguments.frames.empty()) {
            const fs::path strip = folder / (picture.name + "_strip.png");
            draw_strip(reader, picture, arguments.frames, StripRange::of_picture, "", strip,
                       invocation);
            fmt::print("{}\n", strip.string());
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
        render::PngTexts texts = with_command(painter.texts(all), invocation);
        texts[render::k_drawn_with_key] = painter.drawn_with();
        make_folder(folder);  // not before there is a picture
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
                return [arguments](const cli::Invocation& invocation) {
                    return render_stills(*arguments, invocation);
                };
            }};
}

}  // namespace spheroscope
