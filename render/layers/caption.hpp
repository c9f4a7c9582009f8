#pragma once

#include "render/image.hpp"

#include <string>
#include <vector>

namespace spheroscope::render {

/// The lines below a picture of that size, broken between words where they are longer than it is
/// wide.
[[nodiscard]] Image draw_caption(const std::vector<std::string>& lines, int width_px,
                                 int picture_height_px);

}  // namespace spheroscope::render
