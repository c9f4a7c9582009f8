#include "render/layers/colouring.hpp"

#include "render/colour_maps.hpp"

#include <algorithm>
#include <cmath>

namespace spheroscope::render {

double map_position(RangeKind kind, const Range& range, double value) {
    // 0.1 kPa as a float is a little more than 100 Pa: what float32 cannot tell from the end of the
    // range lies in it.
    const double resolution = 1e-6 * (range.high - range.low);
    if (value < range.low - resolution) return -1.0;
    if (value > range.high + resolution) return 2.0;
    const double inside = std::clamp(value, range.low, range.high);
    if (kind != RangeKind::signed_about_zero)
        return (inside - range.low) / (range.high - range.low);
    return 0.5 + 0.5 * inside / std::max(std::abs(range.low), std::abs(range.high));
}

void add_colours(const Field& field, std::span<const float> stored, const Range& range,
                 double paleness, std::vector<Rgb>& colours, ColourCount& count) {
    const ColourMap& map = ColourMap::of(field.range);
    colours.reserve(colours.size() + stored.size());
    for (const float value : stored) {
        Rgb colour = k_absent_colour;
        if (std::isnan(value)) {
            ++count.n_absent;
        } else {
            const double t = map_position(field.range, range,
                                          static_cast<double>(value) * field.shown_per_stored);
            ++count.n_shown;
            if (t < 0.0) ++count.n_below;
            if (t > 1.0) ++count.n_above;
            colour = map.at(t);
        }
        colours.push_back(paleness > 0.0 ? mix(colour, {255, 255, 255}, paleness) : colour);
    }
}

Rgb plain_cell_colour(int cell) {
    // Hues at multiples of the golden angle never repeat and lie far apart for nearby numbers.
    const double hue = 2.399963 * cell;
    const double lightness = 0.86 + 0.035 * std::sin(1.7 * cell);
    return from_oklab({lightness, 0.045 * std::cos(hue), 0.045 * std::sin(hue)});
}

}  // namespace spheroscope::render
