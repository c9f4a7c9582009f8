#pragma once

#include "engine/reports/plot.hpp"
#include "render/png.hpp"

#include <filesystem>

namespace spheroscope::render {

/// Draws a plot with VTK's charts: panels in rows, one legend. Writes a PNG, with `texts` in its
/// file, and an SVG, each complete or absent. Throws Error when there is no OpenGL or when a file
/// cannot be written. The calling thread must not hold another OSMesa context.
void draw_plot(const reports::Plot& plot, const std::filesystem::path& png,
               const std::filesystem::path& svg, const PngTexts& texts = {});

}  // namespace spheroscope::render
