#include "engine/scene/units.hpp"

#include "engine/base/error.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace spheroscope::scene {
namespace {

/// Exponents of length, time, force and angle.
using Exponents = std::array<int, 4>;

struct DimensionRow {
    Dimension dimension;
    std::string_view name, article, unit;
    Exponents exponents;
    SizeLimits limits;
};

// clang-format off
constexpr std::array k_dimensions{
    DimensionRow{Dimension::number, "number", "a plain number", "", {0, 0, 0, 0}, {1e-15, 1e12}},
    DimensionRow{Dimension::length, "length", "a length", "um", {1, 0, 0, 0}, {1e-6, 1e6}},
    DimensionRow{Dimension::area, "area", "an area", "um^2", {2, 0, 0, 0}, {1e-12, 1e12}},
    DimensionRow{Dimension::time, "time", "a time", "s", {0, 1, 0, 0}, {1e-15, 1e9}},
    DimensionRow{Dimension::rate, "rate", "a rate", "1/s", {0, -1, 0, 0}, {1e-9, 1e12}},
    DimensionRow{Dimension::force, "force", "a force", "nN", {0, 0, 1, 0}, {1e-12, 1e9}},
    DimensionRow{Dimension::stiffness, "stiffness", "a stiffness", "kPa", {-2, 0, 1, 0},
                 {1e-12, 1e9}},
    DimensionRow{Dimension::pressure, "pressure", "a pressure", "kPa", {-2, 0, 1, 0}, {1e-12, 1e9}},
    DimensionRow{Dimension::tension, "tension", "a tension", "nN/um", {-1, 0, 1, 0}, {1e-12, 1e9}},
    DimensionRow{Dimension::viscosity, "viscosity", "a viscosity", "kPa s", {-2, 1, 1, 0},
                 {1e-12, 1e9}},
    DimensionRow{Dimension::friction_per_area, "friction per area", "a friction per area",
                 "kPa s/um", {-3, 1, 1, 0}, {1e-12, 1e9}},
    DimensionRow{Dimension::stiffness_per_area, "stiffness per area", "a stiffness per area",
                 "kPa/um", {-3, 0, 1, 0}, {1e-12, 1e9}},
    DimensionRow{Dimension::angle, "angle", "an angle", "rad", {0, 0, 0, 1}, {1e-9, 1e6}},
    DimensionRow{Dimension::view_angle, "angle", "an angle", "deg", {0, 0, 0, 1}, {1e-9, 1e6}},
};
// clang-format on

const DimensionRow& row_of(Dimension dimension) {
    const DimensionRow& row = k_dimensions.at(static_cast<std::size_t>(dimension));
    SPHEROSCOPE_ASSERT(row.dimension == dimension, "rows are in the order of the enumeration");
    return row;
}

/// One unit = engine units * 10^power_of_ten * factor.
struct Unit {
    std::string_view symbol;
    Exponents exponents;
    int power_of_ten = 0;
    double factor = 1.0;
};

constexpr double k_rad_per_deg = std::numbers::pi / 180.0;
constexpr std::array k_units{
    Unit{"nm", {1, 0, 0, 0}, -3},
    Unit{"um", {1, 0, 0, 0}},
    Unit{"mm", {1, 0, 0, 0}, 3},
    Unit{"m", {1, 0, 0, 0}, 6},
    Unit{"us", {0, 1, 0, 0}, -6},
    Unit{"ms", {0, 1, 0, 0}, -3},
    Unit{"s", {0, 1, 0, 0}},
    Unit{"min", {0, 1, 0, 0}, 0, 60.0},
    Unit{"h", {0, 1, 0, 0}, 0, 3600},
    Unit{"pN", {0, 0, 1, 0}, -3},
    Unit{"nN", {0, 0, 1, 0}},
    Unit{"uN", {0, 0, 1, 0}, 3},
    Unit{"mN", {0, 0, 1, 0}, 6},
    Unit{"N", {0, 0, 1, 0}, 9},
    Unit{"Pa", {-2, 0, 1, 0}, -3},
    Unit{"kPa", {-2, 0, 1, 0}},
    Unit{"MPa", {-2, 0, 1, 0}, 3},
    Unit{"GPa", {-2, 0, 1, 0}, 6},
    Unit{"fJ", {1, 0, 1, 0}},
    Unit{"mJ", {1, 0, 1, 0}, 12},
    Unit{"rad", {0, 0, 0, 1}},
    Unit{"deg", {0, 0, 0, 1}, 0, k_rad_per_deg},
    Unit{"°", {0, 0, 0, 1}, 0, k_rad_per_deg},
    Unit{"%", {0, 0, 0, 0}, -2},
    Unit{"1", {0, 0, 0, 0}},
};

const Unit* find_unit(std::string_view symbol) {
    for (const Unit& unit : k_units)
        if (unit.symbol == symbol) return &unit;
    return nullptr;
}

void replace_all(std::string& text, std::string_view from, std::string_view to) {
    for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
}

/// Both micro signs become u, raised digits become powers.
std::string spelled_in_ascii(std::string_view text) {
    std::string plain(text);
    replace_all(plain, "\u00b5", "u");
    replace_all(plain, "\u03bc", "u");
    replace_all(plain, "\u00b2", "^2");
    replace_all(plain, "\u00b3", "^3");
    replace_all(plain, "\u00b7", " ");
    return plain;
}

/// Product of unit symbols, or nothing and `bad_symbol`: the first one that is not known.
std::optional<Unit> parse_unit(std::string_view text, std::string& bad_symbol) {
    Unit product{};
    bool divides = false, symbol_wanted = false;
    while (true) {
        while (!text.empty() && (text[0] == ' ' || text[0] == '*' || text[0] == '/')) {
            if (text[0] != ' ') {
                if (symbol_wanted) bad_symbol = text.substr(0, 1);
                symbol_wanted = true;
            }
            divides = divides || text[0] == '/';
            text.remove_prefix(1);
        }
        if (text.empty()) {
            if (symbol_wanted) bad_symbol = divides ? "/" : "*";
            return bad_symbol.empty() ? std::optional(product) : std::nullopt;
        }
        const std::string_view symbol = text.substr(0, text.find_first_of(" */^"));
        const Unit* unit = find_unit(symbol);
        if (unit == nullptr || !bad_symbol.empty()) {
            if (bad_symbol.empty()) bad_symbol = symbol.empty() ? text.substr(0, 1) : symbol;
            return std::nullopt;
        }
        text.remove_prefix(symbol.size());
        int power = 1;
        if (!text.empty() && text[0] == '^') {
            text.remove_prefix(1);
            const auto read = std::from_chars(text.data(), text.data() + text.size(), power);
            if (read.ec != std::errc{} || std::abs(power) > 9) {
                bad_symbol = std::string(symbol) + "^";
                return std::nullopt;
            }
            text.remove_prefix(static_cast<std::size_t>(read.ptr - text.data()));
        }
        if (divides) power = -power;
        for (std::size_t k = 0; k < product.exponents.size(); ++k)
            product.exponents[k] += power * unit->exponents[k];
        product.power_of_ten += power * unit->power_of_ten;
        if (unit->factor != 1.0) product.factor *= std::pow(unit->factor, power);
        divides = symbol_wanted = false;
    }
}

/// Length of the decimal number at the start of the text; 0 if there is none. An 'e' counts only
/// when digits follow.
std::size_t number_length(std::string_view text, std::size_t& mantissa_length) {
    const auto skip_digits = [&](std::size_t at) {
        while (at < text.size() && text[at] >= '0' && text[at] <= '9') ++at;
        return at;
    };
    std::size_t at = !text.empty() && (text[0] == '-' || text[0] == '+') ? 1 : 0;
    const std::size_t whole = skip_digits(at);
    std::size_t digits = whole - at;
    at = whole;
    if (at < text.size() && text[at] == '.') {
        const std::size_t end = skip_digits(at + 1);
        digits += end - at - 1;
        at = end;
    }
    if (digits == 0) return 0;
    mantissa_length = at;
    if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
        const bool sign = at + 1 < text.size() && (text[at + 1] == '-' || text[at + 1] == '+');
        const std::size_t start = at + (sign ? 2 : 1);
        const std::size_t end = skip_digits(start);
        if (end > start) return end;
    }
    return at;
}

/// Decimal number times 10^shift, rounded once. Infinite when it is too large for a double.
double decimal_value(std::string_view number, std::size_t mantissa_length, int shift) {
    int exponent = 0;
    if (mantissa_length < number.size()) {
        std::string_view written = number.substr(mantissa_length + 1);
        if (written[0] == '+') written.remove_prefix(1);
        const auto read =
            std::from_chars(written.data(), written.data() + written.size(), exponent);
        if (read.ec != std::errc{}) exponent = written[0] == '-' ? -100000 : 100000;
    }
    std::string_view mantissa = number.substr(0, mantissa_length);
    if (mantissa[0] == '+') mantissa.remove_prefix(1);
    const std::string scaled = fmt::format("{}e{}", mantissa, exponent + shift);
    double value = 0.0;
    const auto read = std::from_chars(scaled.data(), scaled.data() + scaled.size(), value);
    if (read.ec == std::errc::result_out_of_range)
        return exponent + shift > 0 ? std::numeric_limits<double>::infinity() : 0.0;
    SPHEROSCOPE_ASSERT(read.ec == std::errc{}, scaled);
    return value;
}

/// "(a tension)"; "(a stiffness or a pressure)"; or that no key of a scene has this dimension.
std::string describe(const Exponents& exponents) {
    std::string names;
    for (const DimensionRow& row : k_dimensions) {
        if (row.exponents != exponents || row.dimension == Dimension::view_angle) continue;
        names += fmt::format("{}{}", names.empty() ? "" : " or ", row.article);
    }
    if (exponents == Exponents{}) return "(no unit)";
    return names.empty() ? "(nothing that a scene has a key for)" : "(" + names + ")";
}

}  // namespace

std::vector<Dimension> all_dimensions() {
    std::vector<Dimension> all;
    for (const DimensionRow& row : k_dimensions) all.push_back(row.dimension);
    return all;
}
std::string_view dimension_name(Dimension dimension) { return row_of(dimension).name; }
std::string_view engine_unit(Dimension dimension) { return row_of(dimension).unit; }
SizeLimits size_limits(Dimension dimension) { return row_of(dimension).limits; }

Quantity parse_quantity(std::string_view text, Dimension wanted) {
    const std::string plain = spelled_in_ascii(text);
    std::string_view rest = plain;
    rest.remove_prefix(std::min(rest.find_first_not_of(' '), rest.size()));
    std::size_t mantissa_length = 0;
    const std::size_t length = number_length(rest, mantissa_length);
    if (length == 0) return {0.0, "(no number)"};
    const std::string_view number = rest.substr(0, length);
    std::string bad_symbol;
    const std::optional<Unit> unit = parse_unit(rest.substr(length), bad_symbol);
    if (!unit) return {0.0, fmt::format("(unknown unit '{}')", bad_symbol)};
    if (unit->exponents != row_of(wanted).exponents) return {0.0, describe(unit->exponents)};

    double value = decimal_value(number, mantissa_length, unit->power_of_ten);
    if (wanted == Dimension::view_angle) {
        if (unit->factor != k_rad_per_deg) value *= unit->factor / k_rad_per_deg;
    } else if (unit->factor != 1.0) {
        value *= unit->factor;
    }
    if (!std::isfinite(value)) return {0.0, "(too large)"};
    return {value, ""};
}

std::string format_quantity(double value, Dimension dimension) {
    const std::string_view unit = engine_unit(dimension);
    return unit.empty() ? fmt::format("{}", value) : fmt::format("{} {}", value, unit);
}

}  // namespace spheroscope::scene
