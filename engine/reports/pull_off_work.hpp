#pragma once

#include "engine/base/vec3.hpp"
#include "engine/scene/scene.hpp"

#include <span>

namespace spheroscope::reports {

/// Work per adhering area of pulling two cells apart as rigid bodies along the line of their
/// centres, over the scene's work of adhesion W: 1 for any shape, if forces are those of the law.
/// The area that adheres is the energy of the contact over -W, so that a rim that is half open
/// counts half. NaN without a contact to pull at. Throws Error unless the scene has two cells that
/// adhere.
[[nodiscard]] double pull_off_work_over_W(const scene::Scene& scene, std::span<const Vec3> x_um,
                                          int threads);

}  // namespace spheroscope::reports
