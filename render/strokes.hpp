#pragma once

#include "render/image.hpp"

#include <span>

namespace spheroscope::render {

/// A point of a picture, px from its upper left corner.
struct PixelPoint {
    double x, y;
};

// All of them blend their edges by the covered share, and cut off what is outside the picture.
void draw_line(Image& image, PixelPoint from, PixelPoint to, double width_px, Rgb colour,
               double opacity = 1.0);
/// A line with a head at its end; one that is shorter than its head is a head alone.
void draw_arrow(Image& image, PixelPoint from, PixelPoint to, double width_px, Rgb colour);
/// A line of dashes, with an arrow's head at its end.
void draw_dashed_arrow(Image& image, PixelPoint from, PixelPoint to, double width_px, Rgb colour);
void fill_disc(Image& image, PixelPoint centre, double radius_px, Rgb colour, double opacity = 1.0);
/// A convex polygon, in either sense of turning.
void fill_convex(Image& image, std::span<const PixelPoint> corners, Rgb colour);

/// Puts `part` into `whole` with its upper left corner at (x, y). Precondition: it fits.
void paste(const Image& part, int x, int y, Image& whole);

}  // namespace spheroscope::render
