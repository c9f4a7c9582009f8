#pragma once

#include "engine/inspect/contact_story.hpp"
#include "render/image.hpp"
#include "render/png.hpp"
#include "render/text.hpp"

#include <filesystem>

namespace spheroscope::render {

/// Draws the forces on one node as a sheet of 1600 x 1000 pixels: arrows, which are as long in each
/// view as the force's components there, and the same forces as numbers.
///
///   title: node, cell, frame, time, scene
///   +-----------------------+---------------------------+
///   | from the side:        | terms, frictions, sums,   |
///   | outward is up         | residual, with units      |
///   +-----------------------+---------------------------+
///   | from outside:         | head to tail: what is     |
///   | the cell's surface    | left open is the residual |
///   +-----------------------+---------------------------+
class NodeSheet {
  public:
    static constexpr int k_width_px = 1600, k_height_px = 1000;

    [[nodiscard]] Image draw(const inspect::NodeMoment& moment);

  private:
    TextPainter text_;
};

/// For the texts of a file with the sheet.
[[nodiscard]] PngTexts node_sheet_texts(const inspect::NodeMoment& moment,
                                        const std::string& made_by, const std::string& command);

}  // namespace spheroscope::render
