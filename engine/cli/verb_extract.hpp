#pragma once

#include "engine/cli/verb.hpp"

namespace spheroscope::cli {

/// `extract`: one contact of a run as a scene of its own.
[[nodiscard]] Verb extract_verb();

}  // namespace spheroscope::cli
