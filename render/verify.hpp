#pragma once

#include "render/frame_source.hpp"
#include "render/image_diff.hpp"
#include "render/png.hpp"

#include <span>
#include <string>
#include <vector>

namespace spheroscope::render {

/// What came of drawing a picture again from what its file says of it.
struct Verification {
    int frame = 0;
    bool is_same_machine = false;  ///< same program, Mesa and VTK: then every bit counts
    Image drawn;
    ImageDifference difference;
    std::vector<std::string> reasons;  ///< why it differs; empty: verified
};

/// runs: of each part of the picture from left to right; the same one again for several frames of
/// one run. Throws Error (usage) when the file
/// does not say how it was drawn, when a run is of another scene or seed, or has no such frame;
/// else as MoviePainter.
[[nodiscard]] Verification verify_picture(const PngFile& file, std::span<FrameSource* const> runs,
                                          const std::string& drawn_by);

/// How many runs, or frames of one, the picture shows side by side. Throws Error when the file does
/// not say how it was drawn.
[[nodiscard]] int n_shown(const PngTexts& texts);

}  // namespace spheroscope::render
