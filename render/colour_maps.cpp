#include "render/colour_maps.hpp"

#include "engine/base/error.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

namespace spheroscope::render {

namespace {

double linear_from_srgb(std::uint8_t byte) {
    const double s = byte / 255.0;
    return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}

double srgb_from_linear(double v) {
    return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1.0 / 2.4) - 0.055;
}

Oklab polar(double lightness, double chroma, double hue_deg) {
    const double hue = hue_deg * std::numbers::pi / 180.0;
    return {lightness, chroma * std::cos(hue), chroma * std::sin(hue)};
}

double distance(const Oklab& p, const Oklab& q) {
    return std::hypot(p.lightness - q.lightness, p.a - q.a, p.b - q.b);
}

/// Walks along a curve, t in 0..1, and returns k_size colours at equal distances from each other.
std::array<Rgb, ColourMap::k_size> equal_steps(const std::function<Oklab(double)>& curve) {
    constexpr int n_fine = 4096;
    std::vector<double> length(n_fine + 1, 0.0);
    for (int i = 1; i <= n_fine; ++i)
        length[static_cast<std::size_t>(i)] =
            length[static_cast<std::size_t>(i - 1)] +
            distance(curve(double(i - 1) / n_fine), curve(double(i) / n_fine));
    std::array<Rgb, ColourMap::k_size> table;
    std::size_t fine = 0;
    for (int k = 0; k < ColourMap::k_size; ++k) {
        const double wanted = length.back() * k / (ColourMap::k_size - 1);
        while (fine + 1 < length.size() && length[fine + 1] < wanted) ++fine;
        const double step = fine + 1 < length.size() ? length[fine + 1] - length[fine] : 1.0;
        const double t = (static_cast<double>(fine) + (wanted - length[fine]) / step) / n_fine;
        table[static_cast<std::size_t>(k)] = from_oklab(curve(std::min(t, 1.0)));
    }
    return table;
}

/// One arm of the diverging map: from near white to a strong dark colour. The chroma follows
/// closely what sRGB can show at that lightness and hue: rising first, falling a little towards the
/// dark end.
Oklab arm(double strength, double hue_deg, double chroma) {
    const double lightness = 0.965 - 0.525 * strength;
    return polar(lightness, chroma * std::sin(0.68 * std::numbers::pi * strength), hue_deg);
}

}  // namespace

Oklab to_oklab(Rgb colour) {
    const double r = linear_from_srgb(colour.r), g = linear_from_srgb(colour.g),
                 b = linear_from_srgb(colour.b);
    const double l = std::cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
    const double m = std::cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
    const double s = std::cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
    return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
            1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
            0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

Rgb from_oklab(const Oklab& c) {
    const auto cube = [](double v) { return v * v * v; };
    const double l = cube(c.lightness + 0.3963377774 * c.a + 0.2158037573 * c.b);
    const double m = cube(c.lightness - 0.1055613458 * c.a - 0.0638541728 * c.b);
    const double s = cube(c.lightness - 0.0894841775 * c.a - 1.2914855480 * c.b);
    const auto byte = [](double linear) {
        const double v = 255.0 * srgb_from_linear(linear);
        SPHEROSCOPE_ASSERT(v > -2.0 && v < 257.0, "a colour of a map lies outside sRGB");
        return static_cast<std::uint8_t>(std::lround(std::clamp(v, 0.0, 255.0)));
    };
    return {byte(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
            byte(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
            byte(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)};
}

const ColourMap& ColourMap::diverging() {
    static const ColourMap map(equal_steps([](double t) {
                                   const double x = 2.0 * t - 1.0;
                                   return x < 0.0 ? arm(-x, 258.0, 0.165) : arm(x, 27.0, 0.185);
                               }),
                               Rgb{0, 214, 222}, Rgb{255, 196, 0});
    return map;
}

const ColourMap& ColourMap::sequential() {
    static const ColourMap map(equal_steps([](double t) {
                                   const double lightness = 0.33 + 0.59 * t;
                                   const double hue_deg = 300.0 - 195.0 * t;
                                   const double chroma =
                                       0.094 + 0.055 * std::pow(t, 3) + 0.05 * std::pow(1.0 - t, 6);
                                   return polar(lightness, chroma, hue_deg);
                               }),
                               Rgb{150, 205, 255}, Rgb{255, 74, 120});
    return map;
}

const ColourMap& ColourMap::of(RangeKind kind) {
    return kind == RangeKind::signed_about_zero ? diverging() : sequential();
}

Rgb ColourMap::at(double t) const {
    if (t < 0.0) return below_;
    if (t > 1.0) return above_;
    return table_[static_cast<std::size_t>(std::lround(t * (k_size - 1)))];
}

}  // namespace spheroscope::render
