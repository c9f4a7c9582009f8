#pragma once

#include "engine/run/snapshot.hpp"

#include <span>
#include <string>

namespace spheroscope::render {

/// A frame as a VTK XML PolyData file (.vtp): nodes and triangles of all cells. Point data: normal
/// and the fields of nodes. Cell data (VTK's cells are our triangles): the fields of triangles, the
/// fields of whole cells and their pressure and volume repeated on each of their triangles, and
/// `cell`, the cell's number. Fields have their engine unit in the name: "sigma_nn (kPa)".
/// Values are float32, as in the run's file, compressed; NaN means that there is nothing.
[[nodiscard]] std::string surfaces_vtp(const Snapshot& snapshot);

/// The contact network of a frame: cell centres, a line for each touching pair. Point data: `cell`.
/// Cell data: "force (nN)" (> 0: repulsion) and "area (um^2)".
[[nodiscard]] std::string network_vtp(const Snapshot& snapshot);

/// A ParaView collection (.pvd) of files over time; names relative to it.
struct DatedFile {
    std::string name;
    double time_s;
};
[[nodiscard]] std::string pvd_text(std::span<const DatedFile> files);

}  // namespace spheroscope::render
