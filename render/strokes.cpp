#include "render/strokes.hpp"

#include "engine/base/error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace spheroscope::render {
namespace {

/// Calls covered(x, y) for all pixels near a rectangle and mixes the colour in by the answer.
template <class Covered> void blend(Image& image, PixelPoint low, PixelPoint high, Rgb colour,
                                    double opacity, Covered covered) {
    const int x0 = std::max(0, static_cast<int>(std::floor(low.x - 1.0)));
    const int y0 = std::max(0, static_cast<int>(std::floor(low.y - 1.0)));
    const int x1 = std::min(image.width - 1, static_cast<int>(std::ceil(high.x + 1.0)));
    const int y1 = std::min(image.height - 1, static_cast<int>(std::ceil(high.y + 1.0)));
    for (int y = y0; y <= y1; ++y)
        for (int x = x0; x <= x1; ++x) {
            const double share = std::clamp(covered(x + 0.5, y + 0.5), 0.0, 1.0) * opacity;
            if (share > 0.0) image.set(x, y, mix(image.at(x, y), colour, share));
        }
}

}  // namespace

void draw_line(Image& image, PixelPoint from, PixelPoint to, double width_px, Rgb colour,
               double opacity) {
    const double dx = to.x - from.x, dy = to.y - from.y;
    const double length2 = dx * dx + dy * dy;
    const double half = 0.5 * width_px;
    blend(image, {std::min(from.x, to.x) - half, std::min(from.y, to.y) - half},
          {std::max(from.x, to.x) + half, std::max(from.y, to.y) + half}, colour, opacity,
          [&](double x, double y) {
              const double along =
                  length2 > 0.0
                      ? std::clamp(((x - from.x) * dx + (y - from.y) * dy) / length2, 0.0, 1.0)
                      : 0.0;
              return half + 0.5 - std::hypot(x - from.x - along * dx, y - from.y - along * dy);
          });
}

namespace {

/// Fills the head, and gives the point where the shaft ends.
PixelPoint draw_head(Image& image, PixelPoint from, PixelPoint to, double width_px, Rgb colour) {
    const double dx = to.x - from.x, dy = to.y - from.y;
    const double length = std::hypot(dx, dy);
    if (length == 0.0) return from;
    const double head = 4.5 * width_px, half = 1.9 * width_px;
    const double ux = dx / length, uy = dy / length;
    const PixelPoint base{to.x - head * ux, to.y - head * uy};
    const std::array<PixelPoint, 3> corners{to, PixelPoint{base.x - half * uy, base.y + half * ux},
                                            PixelPoint{base.x + half * uy, base.y - half * ux}};
    fill_convex(image, corners, colour);
    return length > head ? base : from;
}

}  // namespace

void draw_arrow(Image& image, PixelPoint from, PixelPoint to, double width_px, Rgb colour) {
    const PixelPoint end = draw_head(image, from, to, width_px, colour);
    if (end.x != from.x || end.y != from.y) draw_line(image, from, end, width_px, colour);
}

void draw_dashed_arrow(Image& image, PixelPoint from, PixelPoint to, double width_px, Rgb colour) {
    const PixelPoint end = draw_head(image, from, to, width_px, colour);
    const double length = std::hypot(end.x - from.x, end.y - from.y);
    const double dash = 3.0 * width_px;
    const auto at = [&](double share) {
        return PixelPoint{from.x + share * (end.x - from.x), from.y + share * (end.y - from.y)};
    };
    for (double begin = 0.0; begin < length; begin += 2.0 * dash)
        draw_line(image, at(begin / length), at(std::min(1.0, (begin + dash) / length)), width_px,
                  colour);
}

void fill_disc(Image& image, PixelPoint centre, double radius_px, Rgb colour, double opacity) {
    blend(image, {centre.x - radius_px, centre.y - radius_px},
          {centre.x + radius_px, centre.y + radius_px}, colour, opacity, [&](double x, double y) {
              return radius_px + 0.5 - std::hypot(x - centre.x, y - centre.y);
          });
}

void fill_convex(Image& image, std::span<const PixelPoint> corners, Rgb colour) {
    if (corners.size() < 3) return;
    double twice_area = 0.0;
    PixelPoint low = corners[0], high = corners[0];
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const PixelPoint &p = corners[i], &q = corners[(i + 1) % corners.size()];
        twice_area += p.x * q.y - q.x * p.y;
        low = {std::min(low.x, p.x), std::min(low.y, p.y)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    const double sense = twice_area < 0.0 ? -1.0 : 1.0;
    blend(image, low, high, colour, 1.0, [&](double x, double y) {
        double inside = std::numeric_limits<double>::infinity();  // distance to the nearest edge
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const PixelPoint &p = corners[i], &q = corners[(i + 1) % corners.size()];
            const double length = std::hypot(q.x - p.x, q.y - p.y);
            if (length == 0.0) continue;
            inside = std::min(inside,
                              sense * ((q.x - p.x) * (y - p.y) - (q.y - p.y) * (x - p.x)) / length);
        }
        return inside + 0.5;
    });
}

void paste(const Image& part, int x, int y, Image& whole) {
    SPHEROSCOPE_ASSERT(x >= 0 && y >= 0 && x + part.width <= whole.width &&
                           y + part.height <= whole.height,
                       "a part fits into the whole picture");
    for (int row = 0; row < part.height; ++row)
        std::copy_n(part.rgb.begin() + static_cast<std::ptrdiff_t>(part.offset(0, row)),
                    3 * part.width,
                    whole.rgb.begin() + static_cast<std::ptrdiff_t>(whole.offset(x, y + row)));
}

}  // namespace spheroscope::render
