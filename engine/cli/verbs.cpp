#include "engine/cli/verb.hpp"

namespace spheroscope::cli {

std::vector<Verb> engine_verbs(const reports::DrawPlot& draw) {
    return {run_verb(),    check_verb(),         info_verb(),
            scenes_verb(), precision_verb(draw), stability_verb(draw),
            bench_verb(),  pull_off_verb(draw),  reproduce_verb()};
}

}  // namespace spheroscope::cli
