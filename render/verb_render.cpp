#include "engine/cli/version.hpp"
#include "render/movie_painter.hpp"
#include "render/png.hpp"
#include "render/verb_pictures.hpp"
#include "render/verbs.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <span>

namespace spheroscope {
namespace {

namespace fs = std::filesystem;

struct RenderArguments {
    std::string file;
    std::string picture;
    int frame = -1;
    cli::CommonOptions common;
};

ExitCode render_stills(const RenderArguments& arguments) {
    const RunFileReader reader(arguments.file);
    const int n_frames = reader.n_frames();
    const int frame = arguments.frame < 0 ? n_frames + arguments.frame : arguments.frame;
    if (frame < 0 || frame >= n_frames)
        throw Error(arguments.file + ": there is no frame " + std::to_string(arguments.frame),
                    n_frames == 0 ? "the run has no frames yet"
                                  : "frames are 0 to " + std::to_string(n_frames - 1) +
                                        ", or -1 for the last");
    const fs::path folder = arguments.common.output.empty() ? fs::path(arguments.file).parent_path()
                                                            : fs::path(arguments.common.output);
    std::error_code failed;
    fs::create_directories(folder, failed);
    if (failed)
        throw Error(folder.string() + ": cannot make this folder (" + failed.message() + ")",
                    "choose another one with -o");
    StoredFrames frames(reader);
    for (const scene::Picture& picture :
         choose(pictures_of(reader, arguments.common), arguments.picture)) {
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
                command.option("--picture", arguments->picture,
                               "name of a [[picture]], or 'all'; default: the first");
                cli::add_common_options(command, arguments->common,
                                        {CommonOption::output, CommonOption::set});
                return [arguments](const cli::Invocation&) { return render_stills(*arguments); };
            }};
}

}  // namespace spheroscope
