#pragma once

#include "render/image.hpp"
#include "render/text.hpp"

#include <string>

class vtkContext2D;

namespace spheroscope::render {

/// Strokes, surfaces and words of a plot, in the pixels of its scene (origin at the bottom left).

inline constexpr Rgb k_plot_ink{38, 40, 44};
inline constexpr double k_plot_side_px = 20.0;  ///< free on both sides of a picture

void use_brush(vtkContext2D& painter, Rgb colour);
void use_pen(vtkContext2D& painter, Rgb colour, float width_px);
/// A rectangle in the colour of the brush.
void fill(vtkContext2D& painter, double x0, double y0, double x1, double y1);
/// One line of text with its middle at y; x is its left end, or its middle.
void write(vtkContext2D& painter, double x, double y, const std::string& text, int size, Rgb colour,
           bool is_centred);
/// `words` shortened to the width with which VTK will draw them, before there is a window.
std::string fitting(TextPainter& text, const std::string& words, int size, double width_px,
                    Cut cut = Cut::end, FontStyle font = FontStyle::normal);

}  // namespace spheroscope::render
