#pragma once

#include "engine/model/model.hpp"
#include "engine/scene/scene.hpp"

#include <span>

namespace spheroscope {

/// Does to x_um [all nodes] what the table [start] says: stretches each cell about its centre,
/// makes a sliver of its first triangle, turns everything about the origin, moves everything.
/// Throws Error for a turn about an axis of no length.
void change_start(const scene::Start& start, const Model& model, std::span<Vec3> x_um);

/// The rotation of [start].
[[nodiscard]] Mat3 start_rotation(const scene::Start& start);

}  // namespace spheroscope
