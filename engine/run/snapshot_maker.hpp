#pragma once

#include "engine/measures/measure_input.hpp"
#include "engine/model/prolongation.hpp"
#include "engine/run/snapshot.hpp"
#include "engine/solve/work.hpp"

namespace spheroscope {

/// A frame of the configuration that `input` looks at: positions, node normals, the header's
/// fields, cells and links. Number, time and stage are left to the
/// caller. Every field that is evaluated is counted in work.fields. Fields are shared among
/// workers.
[[nodiscard]] Snapshot make_snapshot(std::shared_ptr<const RunHeader> header,
                                     const MeasureInput& input, const Diagnostics& diagnostics,
                                     const Totals& totals, Work& work, Workers& workers);

/// Shows a snapshot of cells on a coarser mesh on the mesh of its header: surfaces through the old
/// nodes, a triangle's value on its parts, means of neighbours at the new nodes.
void prolong(Snapshot& snapshot, const Prolongation& prolongation);

}  // namespace spheroscope
