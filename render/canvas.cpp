#include "render/canvas.hpp"

#include <algorithm>
#include <cmath>

namespace spheroscope::render {

namespace {

/// Length of [a0, a1] that lies inside the pixel [i, i + 1].
double overlap(double a0, double a1, int i) {
    return std::max(0.0, std::min(a1, i + 1.0) - std::max(a0, static_cast<double>(i)));
}

}  // namespace

void fill_rectangle(Image& image, double x0, double y0, double x1, double y1, Rgb colour,
                    double opacity) {
    const int first_x = std::max(0, static_cast<int>(std::floor(x0)));
    const int last_x = std::min(image.width - 1, static_cast<int>(std::ceil(x1)) - 1);
    const int first_y = std::max(0, static_cast<int>(std::floor(y0)));
    const int last_y = std::min(image.height - 1, static_cast<int>(std::ceil(y1)) - 1);
    for (int y = first_y; y <= last_y; ++y)
        for (int x = first_x; x <= last_x; ++x) {
            const double cover = overlap(x0, x1, x) * overlap(y0, y1, y);
            image.set(x, y, mix(image.at(x, y), colour, opacity * cover));
        }
}

void fill_tip(Image& image, double x0, double x1, double y, double y_tip, Rgb colour) {
    constexpr int n_slices = 4;  // per pixel row
    const double top = std::min(y, y_tip), bottom = std::max(y, y_tip);
    const int first_y = std::max(0, static_cast<int>(std::floor(top)));
    const int last_y = std::min(image.height - 1, static_cast<int>(std::ceil(bottom)) - 1);
    const int first_x = std::max(0, static_cast<int>(std::floor(x0)));
    const int last_x = std::min(image.width - 1, static_cast<int>(std::ceil(x1)) - 1);
    for (int row = first_y; row <= last_y; ++row)
        for (int x = first_x; x <= last_x; ++x) {
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
