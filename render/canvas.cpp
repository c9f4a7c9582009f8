#include "render/canvas.hpp"

#include <algorithm>
#include <cmath>

namespace spheroscope::render {

namespace {

/// Length of [a0, a1] that lies inside the pixel [i, i + 1].
double overlap(double a0, double a1, int i) {
    return std::max(0.0, std::min(a1, i + 1.0) - std::max(a0, static_cast<double>(i)));
}

/// The pixels of a row or column of n that [a0, a1] touches; none for what is no number.
struct Pixels {
    int first = 0, last = -1;
};
Pixels touched(double a0, double a1, int n) {
    if (!(a0 < n && a1 > 0.0)) return {};
    // Before the conversion: an int does not hold every double.
    return {static_cast<int>(std::floor(std::max(a0, 0.0))),
            static_cast<int>(std::ceil(std::min<double>(a1, n))) - 1};
}

}  // namespace

void fill_rectangle(Image& image, double x0, double y0, double x1, double y1, Rgb colour,
                    double opacity) {
    const Pixels columns = touched(x0, x1, image.width), rows = touched(y0, y1, image.height);
    for (int y = rows.first; y <= rows.last; ++y)
        for (int x = columns.first; x <= columns.last; ++x) {
            const double cover = overlap(x0, x1, x) * overlap(y0, y1, y);
            image.set(x, y, mix(image.at(x, y), colour, opacity * cover));
        }
}

void fill_tip(Image& image, double x0, double x1, double y, double y_tip, Rgb colour) {
    constexpr int n_slices = 4;  // per pixel row
    const double top = std::min(y, y_tip), bottom = std::max(y, y_tip);
    const Pixels columns = touched(x0, x1, image.width), rows = touched(top, bottom, image.height);
    for (int row = rows.first; row <= rows.last; ++row)
        for (int x = columns.first; x <= columns.last; ++x) {
            double cover = 0.0;
            for (int k = 0; k < n_slices; ++k) {
                const double at = row + (k + 0.5) / n_slices;
                if (at < top || at > bottom) continue;
                const double inset = 0.5 * (x1 - x0) * (at - y) / (y_tip - y);
                cover += overlap(x0 + inset, x1 - inset, x) / n_slices;
            }
            image.set(x, row, mix(image.at(x, row), colour, cover));
        }
}

}  // namespace spheroscope::render
