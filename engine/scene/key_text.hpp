#pragma once

#include "engine/scene/keys.hpp"

#include <string>

namespace spheroscope::scene {

/// A TOML string in double quotes.
[[nodiscard]] std::string toml_string(const std::string& text);

/// The value of a key as TOML, in engine units: "20 kPa" in quotes, true, [0.0, 1.0]. Empty for a
/// number without a finite value (an open bound of [expect]).
[[nodiscard]] std::string value_text(Draft& draft, const Key& key, std::size_t item);

}  // namespace spheroscope::scene
