#include "render/image.hpp"

#include <algorithm>
#include <cmath>

namespace spheroscope::render {

Image::Image(int width_px, int height_px, Rgb fill) : width(width_px), height(height_px) {
    const std::size_t n_pixels =
        static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
    rgb.resize(3 * n_pixels);
    for (std::size_t i = 0; i < n_pixels; ++i) {
        rgb[3 * i] = fill.r;
        rgb[3 * i + 1] = fill.g;
        rgb[3 * i + 2] = fill.b;
    }
}

Image enlarged(const Image& image, int n, int width_px, int height_px) {
    Image large(width_px, height_px);
    for (int y = 0; y < height_px; ++y) {
        std::uint8_t* const row = large.rgb.data() + large.offset(0, y);
        if (y % n > 0) {
            std::copy_n(large.rgb.data() + large.offset(0, y - 1), 3 * width_px, row);
            continue;
        }
        for (int x = 0; x < width_px; ++x)
            std::copy_n(image.rgb.data() + image.offset(x / n, y / n), 3, row + 3 * x);
    }
    return large;
}

Rgb mix(Rgb a, Rgb b, double share) {
    const auto channel = [share](std::uint8_t from, std::uint8_t to) {
        return static_cast<std::uint8_t>(std::lround(from + share * (to - from)));
    };
    return {channel(a.r, b.r), channel(a.g, b.g), channel(a.b, b.b)};
}

}  // namespace spheroscope::render
