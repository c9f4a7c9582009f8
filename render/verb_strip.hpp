#pragma once

#include "engine/cli/verb.hpp"
#include "render/png.hpp"
#include "render/verb_pictures.hpp"

#include <filesystem>
#include <string>

namespace spheroscope {

/// Which range of colours the pictures of a strip have.
enum class StripRange {
    of_picture,    ///< as the scene's picture says: of the run, given, or each frame's own
    without_wall,  ///< unless it is given: that of the frames shown in which no wall presses
};

/// Draws frames of a run beside each other, with one scale, a heading for each, and a caption with
/// scene, frames, range and command, into a PNG. list: as --frames takes it, "anneal,120,-1".
/// Throws Error for a list with what there is not.
void draw_strip(const RunFileReader& reader, scene::Picture picture, const std::string& list,
                StripRange range, const std::string& title, const std::filesystem::path& path,
                const cli::Invocation& invocation);

/// The texts of a picture's file with the command that has drawn it as `Command`, and that of the
/// run as `Run command`.
[[nodiscard]] render::PngTexts with_command(render::PngTexts texts,
                                            const cli::Invocation& invocation);

}  // namespace spheroscope
