#pragma once

#include <string>

namespace spheroscope {

/// A text as one value of a line of CSV (RFC 4180): in quotes where it has a comma, a quote or a
/// line break.
[[nodiscard]] std::string csv_word(const std::string& text);

}  // namespace spheroscope
