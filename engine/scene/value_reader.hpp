#pragma once

#include "engine/scene/keys.hpp"

namespace spheroscope::scene {

/// Reads one value into the member of its key, with checks of type, dimension, range and words.
/// `path` stands for the key in messages: "stage[2].cap". Throws Error with the quoted line.
void read_value(Draft& draft, const Key& key, const Value& value, const std::string& path,
                std::size_t item);

}  // namespace spheroscope::scene
