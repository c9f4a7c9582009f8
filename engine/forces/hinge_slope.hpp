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

/// A hinge as a force reads it: its angle theta by cosine and sine, without an inverse function,
/// and the slope of theta. Precondition: neither triangle has zero area.
struct Hinge {
    double cosine, sine;
    HingeSlope slope;

    Hinge(const Vec3& i, const Vec3& j, const Vec3& a, const Vec3& b);

    /// Of theta - theta*.
    [[nodiscard]] double cosine_of_turn(double rest_cosine, double rest_sine) const {
        return cosine * rest_cosine + sine * rest_sine;
    }
    [[nodiscard]] double sine_of_turn(double rest_cosine, double rest_sine) const {
        return sine * rest_cosine - cosine * rest_sine;
    }
};

}  // namespace spheroscope
