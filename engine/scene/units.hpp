#pragma once

#include <string>
#include <string_view>
#include <vector>

// Quantities of scene files: "20 kPa", "0.5 mN/m", "200 nm", "1 kPa s", "90 deg" become numbers in
// the engine's units (um, s, nN). A power of ten between the given unit and the engine's goes into
// the exponent of the decimal number, so "200 nm" is the double nearest to 0.2, not 200 * 0.001.
namespace spheroscope::scene {

/// What a key of a scene measures. One row for each in units.cpp: its words and its engine unit.
enum class Dimension {
    number,
    length,
    area,
    time,
    rate,
    force,
    stiffness,
    pressure,
    tension,
    viscosity,
    friction_per_area,
    stiffness_per_area,
    angle,       ///< rad
    view_angle,  ///< deg: the same quantity, counted as people turn pictures
};

[[nodiscard]] std::vector<Dimension> all_dimensions();
/// "stiffness", "friction per area".
[[nodiscard]] std::string_view dimension_name(Dimension dimension);
/// Engine unit in ASCII: "kPa", "nN/um"; "" for a plain number.
[[nodiscard]] std::string_view engine_unit(Dimension dimension);

/// Sizes beyond which no quantity of this kind can be meant, in its engine unit: nothing is larger,
/// and what cannot be zero is not smaller. They are far from what cells have, and far from where
/// sums and products of doubles lose their meaning.
struct SizeLimits {
    double smallest, largest;
};
[[nodiscard]] SizeLimits size_limits(Dimension dimension);

/// What came of reading a quantity. `problem` says in words what was got instead, ready to follow
/// 'got "20 nN/um" ' in a message: "(a tension)", "(no unit)"; empty if all went well.
struct Quantity {
    double value = 0.0;  ///< in the engine unit of the wanted dimension
    std::string problem;
    [[nodiscard]] bool ok() const { return problem.empty(); }
};

/// Reads a decimal number followed by a unit. A unit is a product of symbols, joined by spaces, '*'
/// or '/', each with an optional power: "kPa s", "nN/um^2", "1/s". '/' divides by the next symbol
/// only. µ may stand for u; '%' is a hundredth. A number alone is a plain number.
[[nodiscard]] Quantity parse_quantity(std::string_view text, Dimension wanted);

/// The shortest text from which parse_quantity gives back exactly this number: "0.2 um".
[[nodiscard]] std::string format_quantity(double value, Dimension dimension);

}  // namespace spheroscope::scene
