#pragma once

#include "render/image.hpp"
#include "render/text.hpp"

#include <optional>
#include <string>
#include <vector>

namespace spheroscope::render {

/// A small chart with linear axes inside a picture: lines or dots, ticks with labels, titles with
/// units.
struct LineChart {
    struct Series {
        std::string name;  ///< of the key; "" is not in it
        Rgb colour;
        std::vector<double> x, y;  ///< NaN: a gap in the line
        bool dots = false;         ///< dots instead of a line
    };
    std::string title, x_title, y_title;
    std::vector<Series> series;
    std::optional<double> cursor;  ///< an upright line at this x
};

/// Draws it into the rectangle [x0, x1) x [y0, y1), px, everything included. Ranges are those of
/// the values; y includes zero.
void draw_line_chart(Image& image, TextPainter& text, const LineChart& chart, double x0, double y0,
                     double x1, double y1);

/// The distance of ticks, 1, 2 or 5 times a power of ten, that cuts a span into at most n parts.
[[nodiscard]] double tick_step(double span, int n);
/// No more digits than the step needs, a true minus sign.
[[nodiscard]] std::string tick_label(double value, double step);

}  // namespace spheroscope::render
