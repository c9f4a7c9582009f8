#pragma once

#include "viewer/model/pick.hpp"
#include "viewer/model/series.hpp"

#include <optional>

namespace spheroscope::viewer {

/// Where a number of the health strip is worst in this frame. Of triangles: the smallest one, over
/// the mean of its cell, and the contact that it lies in; of volumes: the cell with the largest
/// error. A cell that is to blame without such a place leads to its contact of the largest force,
/// and what no cell is to blame for (the force balance) to that of all contacts. Empty without any.
[[nodiscard]] std::optional<Pick> blamed(const SeriesRow& row, const Snapshot& snapshot);

}  // namespace spheroscope::viewer
