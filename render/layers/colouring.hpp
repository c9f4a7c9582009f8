#pragma once

#include "engine/measures/fields.hpp"
#include "render/image.hpp"
#include "render/range.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace spheroscope::render {

/// How many values got which kind of colour.
struct ColourCount {
    std::int64_t n_shown = 0;               ///< values that are not NaN
    std::int64_t n_absent = 0;              ///< NaN: nothing to measure
    std::int64_t n_below = 0, n_above = 0;  ///< of the shown ones, outside the range
};

/// Where in the colour map of its kind a value stands, 0..1; below 0 or above 1 for a value outside
/// the range. A signed field has zero at 0.5 whatever its range is: a range from -100 to 300 uses
/// the red half of the map, and a third of the blue one. value and range: shown unit.
[[nodiscard]] double map_position(RangeKind kind, const Range& range, double value);

/// Colours of stored values of a field; NaN becomes k_absent_colour. `paleness` 0..1 mixes white
/// in. Adds to `count`; appends to `colours`.
void add_colours(const Field& field, std::span<const float> stored, const Range& range,
                 double paleness, std::vector<Rgb>& colours, ColourCount& count);

/// A soft tint for a cell that shows no field; neighbours in the numbering differ.
[[nodiscard]] Rgb plain_cell_colour(int cell);

/// How pale the cells are made behind a contact network, so that its tubes stand out.
inline constexpr double k_paleness_behind_network = 0.35;

}  // namespace spheroscope::render
