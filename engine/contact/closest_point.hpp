#pragma once

#include "engine/base/vec3.hpp"

#include <array>

namespace spheroscope {

/// Barycentric coordinates of the point of a triangle that is nearest to p (Ericson 2005, 5.1.5).
/// On an edge or a corner the coordinates of the other corners are exactly 0, so a reader can tell
/// which feature is nearest. Precondition: the triangle has an area.
[[nodiscard]] std::array<double, 3> closest_barycentric(const Vec3& p_um, const Vec3& a_um,
                                                        const Vec3& b_um, const Vec3& c_um);

}  // namespace spheroscope
