#pragma once

#include "engine/cli/verb.hpp"
#include "engine/inspect/contact_story.hpp"

namespace spheroscope::cli {

/// `inspect`; the functions that draw are empty in a program without pictures.
[[nodiscard]] Verb inspect_verb(const inspect::Drawers& drawers);

}  // namespace spheroscope::cli
