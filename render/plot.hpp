#pragma once

#include "engine/reports/plot.hpp"

#include <filesystem>

namespace spheroscope::render {

/// Draws a plot with VTK's charts: panels in rows of up to three, one legend. Writes a PNG and an
/// SVG, each complete or absent. Throws Error when there is no OpenGL or when a file cannot be
/// written. The calling thread must not hold another OSMesa context.
void draw_plot(const reports::Plot& plot, const std::filesystem::path& png,
               const std::filesystem::path& svg);

}  // namespace spheroscope::render
