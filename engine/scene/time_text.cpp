#include "engine/scene/time_text.hpp"

#include "engine/base/error.hpp"
#include "engine/scene/units.hpp"

#include <fmt/format.h>

namespace spheroscope::scene {

Quantity parse_time(std::string_view text) {
    const Quantity seconds = parse_quantity(text, Dimension::number);
    return seconds.ok() ? seconds : parse_quantity(text, Dimension::time);
}

double parse_span_s(std::string_view what, std::string_view text, std::string_view example) {
    const Quantity time = parse_quantity(text, Dimension::time);
    if (!time.ok() || !(time.value > 0.0))
        throw Error(
            fmt::format("{} wants a time above zero, got \"{}\" {}", what, text, time.problem),
            fmt::format("for instance {} '{}'", what, example));
    return time.value;
}

}  // namespace spheroscope::scene
