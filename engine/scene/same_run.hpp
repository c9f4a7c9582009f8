#pragma once

#include <string>

namespace spheroscope::scene {

/// Whether a stored run, of this resolved scene, is the run that the other resolved scene asks for.
/// Only what the engine reads counts: other pictures are the same run, and so is a scene that an
/// earlier version resolved, without the keys that have come since.
[[nodiscard]] bool is_same_run(const std::string& stored_toml, const std::string& wanted_toml);

}  // namespace spheroscope::scene
