#pragma once

#include "engine/run/snapshot.hpp"

namespace spheroscope {

/// Middle of one cell, um.
[[nodiscard]] Vec3 cell_centre_um(const Snapshot& snapshot, std::size_t cell);
/// Middle of the aggregate: the cells' centres weighted with their volumes, um.
[[nodiscard]] Vec3 aggregate_centre_um(const Snapshot& snapshot);
/// Distance of the farthest node from there, um.
[[nodiscard]] double aggregate_extent_um(const Snapshot& snapshot);

}  // namespace spheroscope
