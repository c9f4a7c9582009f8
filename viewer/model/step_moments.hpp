#pragma once

#include "engine/run/step_anatomy.hpp"
#include "viewer/model/pick.hpp"

#include <string>
#include <vector>

namespace spheroscope::viewer {

/// One stop on the way through a step: what has happened so far, as a table.
struct StepMoment {
    std::string what;
    std::vector<TableRow> rows;
    const SolveHistory* solve = nullptr;  ///< of the anatomy; nullptr: no solve
};

/// The stops of a step: the start, one after each term of each evaluation, each solve, the end.
/// The anatomy must outlive them.
[[nodiscard]] std::vector<StepMoment> moments_of(const StepAnatomy& anatomy);

}  // namespace spheroscope::viewer
