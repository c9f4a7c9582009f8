#include "render/image.hpp"

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

Rgb mix(Rgb a, Rgb b, double share) {
    const auto channel = [share](std::uint8_t from, std::uint8_t to) {
        return static_cast<std::uint8_t>(std::lround(from + share * (to - from)));
    };
    return {channel(a.r, b.r), channel(a.g, b.g), channel(a.b, b.b)};
}

}  // namespace spheroscope::render
