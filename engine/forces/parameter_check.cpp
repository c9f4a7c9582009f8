#include "engine/forces/parameter_check.hpp"

#include <cmath>
#include <sstream>
#include <string>

namespace spheroscope {
namespace {

std::string text_of(double value, std::string_view unit) {
    std::ostringstream out;
    out << value;
    if (!unit.empty()) out << ' ' << unit;
    return out.str();
}

[[noreturn]] void refuse(const Loc& loc, std::string_view key, const std::string& wanted,
                         double value, std::string_view unit) {
    throw Error(loc, std::string(key) + " wants " + wanted + ", got " + text_of(value, unit));
}

}  // namespace

void want_positive(const Loc& loc, std::string_view key, double value, std::string_view unit) {
    if (!(std::isfinite(value) && value > 0.0)) refuse(loc, key, "a value above 0", value, unit);
}

void want_not_negative(const Loc& loc, std::string_view key, double value, std::string_view unit) {
    if (!(std::isfinite(value) && value >= 0.0))
        refuse(loc, key, "a value of at least 0", value, unit);
}

void want_finite(const Loc& loc, std::string_view key, double value, std::string_view unit) {
    if (!std::isfinite(value)) refuse(loc, key, "a finite value", value, unit);
}

void want_between(const Loc& loc, std::string_view key, double value, double low, double high,
                  std::string_view unit) {
    if (!(value > low && value < high))
        refuse(loc, key, "a value between " + text_of(low, unit) + " and " + text_of(high, unit),
               value, unit);
}

}  // namespace spheroscope
