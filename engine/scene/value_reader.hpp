#pragma once

#include "engine/scene/keys.hpp"

#include <string>

namespace spheroscope::scene {

/// Reads one value into the member of its key, with checks of type, dimension, range and words.
/// `path` stands for the key in messages: "stage[2].cap". Throws Error with the quoted line.
void read_value(Draft& draft, const Key& key, const Value& value, const std::string& path,
                std::size_t item);

/// What a number of this key must be by the key's own bound, "> 0", or by the sizes of its kind;
/// empty if this one is. Precondition: it is finite.
[[nodiscard]] std::string missed_limits(const Key& key, double number);
/// The sizes that a number of this key may have by its kind, "1e-06 ... 1e+06 um", if this one has
/// another; empty if all is well. Precondition: it is finite and within the key's own bound.
[[nodiscard]] std::string missed_sizes(const Key& key, double number);

}  // namespace spheroscope::scene
