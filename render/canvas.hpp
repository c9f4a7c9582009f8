#pragma once

#include "render/image.hpp"

namespace spheroscope::render {

/// Fills the rectangle [x0, x1) x [y0, y1), px; edges between pixels are blended by the covered
/// share, and what is outside the picture is cut off.
void fill_rectangle(Image& image, double x0, double y0, double x1, double y1, Rgb colour,
                    double opacity = 1.0);
/// A triangle with one horizontal side from (x0, y) to (x1, y) and its tip at ((x0 + x1) / 2,
/// y_tip).
void fill_tip(Image& image, double x0, double x1, double y, double y_tip, Rgb colour);

}  // namespace spheroscope::render
