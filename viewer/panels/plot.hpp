#pragma once

#include "viewer/model/series.hpp"

#include <limits>
#include <string>

struct ImFont;

namespace spheroscope::viewer {

/// A small plot in a panel.
enum class PlotKind { line, steps, bars };

struct Plot {
    std::string title;  ///< with unit
    std::string x_label;
    PlotKind kind = PlotKind::line;
    Curve curve;
    float now = std::numeric_limits<float>::quiet_NaN();  ///< marked on the x axis
    bool from_zero = false;                               ///< of y
};

/// Draws it at the cursor, this large.
void draw_plot(const Plot& plot, float width, float height, ImFont* font);

}  // namespace spheroscope::viewer
