#pragma once

#include "engine/run/snapshot.hpp"

#include <span>
#include <string>
#include <vector>

namespace spheroscope::render {

/// What tells runs apart that are shown beside each other, a line for each: "seed = 2",
/// "cells.nodes = 642, without [cytosol]". Settings of the motion come in the order of scenes, then
/// what was changed on the way, then the program's version; titles and pictures are no difference.
/// Empty for runs that are the same in all of these. last_frames: of each run, with its changes.
[[nodiscard]] std::vector<std::string> what_differs(std::span<const SnapshotPtr> last_frames);

}  // namespace spheroscope::render
