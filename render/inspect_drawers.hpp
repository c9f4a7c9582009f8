#pragma once

#include "engine/inspect/contact_story.hpp"

namespace spheroscope {

/// Draws the sheets and movies of `inspect`.
[[nodiscard]] inspect::Drawers inspect_drawers();

}  // namespace spheroscope
