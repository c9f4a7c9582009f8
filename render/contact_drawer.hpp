#pragma once

#include "engine/inspect/contact_story.hpp"

namespace spheroscope {

/// Draws the sheets and movies of `inspect`.
[[nodiscard]] inspect::DrawContact contact_drawer();

}  // namespace spheroscope
