#include "render/layers/colouring.hpp"

#include "render/colour_maps.hpp"

#include <cmath>

namespace spheroscope::render {

void add_colours(const Field& field, std::span<const float> stored, const Range& range,
                 double paleness, std::vector<Rgb>& colours, ColourCount& count) {
    const ColourMap& map = ColourMap::of(field.range);
    const double scale = field.shown_per_stored / (range.high - range.low);
    const double offset = range.low / (range.high - range.low);
    colours.reserve(colours.size() + stored.size());
    for (const float value : stored) {
        Rgb colour = k_absent_colour;
        if (std::isnan(value)) {
            ++count.n_absent;
        } else {
            double t = static_cast<double>(value) * scale - offset;
            // 0.1 kPa as a float is a little more than 100 Pa: what float32 cannot tell from the
            // end of the range lies in it.
            constexpr double resolution = 1e-6;
            if (t < 0.0 && t > -resolution) t = 0.0;
            if (t > 1.0 && t < 1.0 + resolution) t = 1.0;
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
