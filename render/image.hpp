#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace spheroscope::render {

/// One pixel, 8 bits per channel, sRGB.
struct Rgb {
    std::uint8_t r = 0, g = 0, b = 0;
    bool operator==(const Rgb&) const = default;
};

/// A picture: rows from the top, three bytes per pixel.
struct Image {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgb;  ///< [height * width * 3]

    Image() = default;
    Image(int width_px, int height_px, Rgb fill = {255, 255, 255});

    [[nodiscard]] std::size_t offset(int x, int y) const {
        return 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                    static_cast<std::size_t>(x));
    }
    [[nodiscard]] Rgb at(int x, int y) const {
        const std::uint8_t* p = rgb.data() + offset(x, y);
        return {p[0], p[1], p[2]};
    }
    void set(int x, int y, Rgb colour) {
        std::uint8_t* p = rgb.data() + offset(x, y);
        p[0] = colour.r;
        p[1] = colour.g;
        p[2] = colour.b;
    }
    bool operator==(const Image&) const = default;
};

/// Each pixel n x n times, cut at this width and height. Precondition: n times the image covers
/// them.
[[nodiscard]] Image enlarged(const Image& image, int n, int width_px, int height_px);

/// (1 - share) * a + share * b, share in 0..1.
[[nodiscard]] Rgb mix(Rgb a, Rgb b, double share);

}  // namespace spheroscope::render
