#include "engine/cli/verb.hpp"

namespace spheroscope::cli {

std::vector<Verb> engine_verbs() { return {check_verb(), scenes_verb()}; }

}  // namespace spheroscope::cli
