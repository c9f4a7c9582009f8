#include "engine/cli/verb.hpp"

namespace spheroscope::cli {

std::vector<Verb> engine_verbs() { return {run_verb(), check_verb(), info_verb(), scenes_verb()}; }

}  // namespace spheroscope::cli
