#pragma once

#include "engine/run/snapshot.hpp"

namespace spheroscope {

/// The frame with each cell moved, as it is, away from the aggregate's middle (its cells weighted
/// with their volumes) by `share` of its centre's distance from there. The middle stays.
[[nodiscard]] Snapshot exploded(const Snapshot& snapshot, double share);

/// By how much one cell is moved there, um.
[[nodiscard]] Vec3 shift_when_exploded_um(const Snapshot& snapshot, double share, int cell);

}  // namespace spheroscope
