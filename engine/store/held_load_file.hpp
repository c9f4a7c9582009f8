#pragma once

#include "engine/stages/build.hpp"

#include <optional>
#include <string>

namespace spheroscope {

/// Adds a load to the file of a run (group /held). Throws Error when that cannot be written.
void write_held_load(const std::string& path, const HeldLoad& load);

/// The load that a run's file holds; empty if it has none. Throws Error when the file is damaged.
[[nodiscard]] std::optional<HeldLoad> read_held_load(const std::string& path);

}  // namespace spheroscope
