#pragma once

#include <span>
#include <string_view>
#include <vector>

namespace spheroscope {

struct MeasureInput;

/// Where a field's values live; its array has n_cells * (nodes | triangles | 1) entries, cell by
/// cell.
enum class Place { node, triangle, cell };

/// What kind of number it is decides the colour map and the range: `signed_about_zero` gets a
/// diverging map, symmetric about zero (compression blue, tension red); `magnitude` a sequential
/// one from zero.
enum class RangeKind { signed_about_zero, magnitude };

/// The part of the model without which a field has no meaning in a scene.
enum class Requires { nothing, elastic, contact, cytosol };

/// One row of the table of fields: everything that the legend, the file, the panel and the docs
/// need. A value of NaN means 'there is nothing to measure here' (a triangle without contact),
/// never zero.
struct Field {
    std::string_view name;        ///< key in scene files and in the HDF5 file, e.g. "sigma_nn"
    std::string_view symbol;      ///< for legends, UTF-8, e.g. "σ^c_nn"
    std::string_view unit;        ///< of the stored values, ASCII, e.g. "kPa"
    std::string_view shown_unit;  ///< of the legend, UTF-8, e.g. "Pa"
    double shown_per_stored;      ///< shown value = stored value * this (kPa -> Pa: 1000)
    Place place;
    RangeKind range;
    std::string_view absent;       ///< what NaN means in words for the key, "" if it cannot occur
    std::string_view description;  ///< one sentence
    std::string_view source;       ///< e.g. "Cuvelier et al. 2021, eqn (3)"
    /// Fills `out` (size by `place`). Reads only what the input holds.
    void (*compute)(const MeasureInput&, std::span<float> out);
    Requires requires_part = Requires::nothing;
};

/// All fields, in the order of legends and combo boxes.
[[nodiscard]] std::span<const Field> all_fields();

/// Whether values above zero are a tension and those below it a compression: so it is for all
/// signed fields but shear components.
[[nodiscard]] bool is_tension_or_compression(const Field& field);

/// nullptr when there is no such field.
[[nodiscard]] const Field* find_field(std::string_view name);

}  // namespace spheroscope
