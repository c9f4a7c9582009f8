#pragma once

#include "engine/base/error.hpp"

#include <string_view>

namespace spheroscope {

/// Throws Error at `loc` unless value is finite and > 0; `key` and `unit` name it in the message.
void want_positive(const Loc& loc, std::string_view key, double value, std::string_view unit);
/// The same for value >= 0.
void want_not_negative(const Loc& loc, std::string_view key, double value, std::string_view unit);
/// The same for any finite value.
void want_finite(const Loc& loc, std::string_view key, double value, std::string_view unit);
/// The same for low < value < high.
void want_between(const Loc& loc, std::string_view key, double value, double low, double high,
                  std::string_view unit);

}  // namespace spheroscope
