#pragma once

#include "engine/scene/scene.hpp"

#include <vector>

namespace spheroscope::reports {

/// What a variant of a scene changes in it. Throws Error with its place when it is not of the form
/// key=value.
[[nodiscard]] std::vector<scene::Override> overrides_of(const scene::Variant& variant);

}  // namespace spheroscope::reports
