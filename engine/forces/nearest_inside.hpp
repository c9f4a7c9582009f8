#pragma once

#include "engine/model/load.hpp"

#include <array>
#include <span>

namespace spheroscope {

/// The point of a convex polyhedron that is nearest to a point outside of it.
struct NearestInside {
    Vec3 point_um;
    /// Orthonormal, spans the normals of the planes that it lies on: one on a face, two on an edge,
    /// three in a corner.
    std::array<Vec3, 3> across;
    int n_across = 0;  ///< 0: the point is inside, and its own nearest one
};

/// The polyhedron is that of all points inside of these planes, and not empty; it may be unbounded.
/// The way to the nearest point is a continuous function of x, in corners too, so that half its
/// square is an energy with a continuous force. Planes are added one after the other; the nearest
/// point moves only when it is outside of the new plane, and then lies on it, which leaves the same
/// question with one dimension less (Seidel, Discrete Comput. Geom. 6, 1991, 423).
[[nodiscard]] NearestInside nearest_inside(std::span<const Hull::Plane* const> planes,
                                           const Vec3& x_um);

}  // namespace spheroscope
