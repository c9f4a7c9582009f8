#pragma once

#include "engine/base/vec3.hpp"

#include <array>

namespace spheroscope {

/// How a hinge's angle (engine/model/model.hpp) depends on the places of its nodes: two vectors
/// along the normals of its triangles, and where the feet of the wings a and b stand on the edge.
struct HingeSlope {
    Vec3 by_a, by_b;        ///< rad/um
    double foot_a, foot_b;  ///< 0 at i, 1 at j

    /// Derivatives by i, j, a, b. They sum to zero and make no torque.
    [[nodiscard]] std::array<Vec3, 4> gradient() const {
        return {(foot_a - 1.0) * by_a + (foot_b - 1.0) * by_b, -foot_a * by_a - foot_b * by_b, by_a,
                by_b};
    }
};

/// Precondition: neither triangle has zero area.
[[nodiscard]] HingeSlope hinge_slope(const Vec3& i, const Vec3& j, const Vec3& a, const Vec3& b);

}  // namespace spheroscope
