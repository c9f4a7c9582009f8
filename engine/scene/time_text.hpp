#pragma once

#include <string_view>

namespace spheroscope::scene {

struct Quantity;

/// Reads a time as people type it where nothing but a time can be meant: "350 ms", "2 min", or
/// seconds without a unit, "12.5".
[[nodiscard]] Quantity parse_time(std::string_view text);

/// Reads a span of time, which is above zero and has a unit: "20 min" and "20 s" are far apart, and
/// a number alone would be either. Throws Error that names `what` ("--duration")
/// and has `example` for a hint.
[[nodiscard]] double parse_span_s(std::string_view what, std::string_view text,
                                  std::string_view example);

}  // namespace spheroscope::scene
