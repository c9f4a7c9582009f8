#pragma once

#include "engine/measures/measure_input.hpp"
#include "engine/run/snapshot.hpp"

namespace spheroscope {

/// A frame of the configuration that `input` looks at: positions, node normals, the header's
/// fields, cells and links. Number, time and stage are left to the caller.
[[nodiscard]] Snapshot make_snapshot(std::shared_ptr<const RunHeader> header,
                                     const MeasureInput& input, const Diagnostics& diagnostics,
                                     const Totals& totals);

}  // namespace spheroscope
