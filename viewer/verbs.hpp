#pragma once

#include "engine/cli/verb.hpp"

namespace spheroscope {

/// The panel.
[[nodiscard]] cli::Verb view_verb();

}  // namespace spheroscope
