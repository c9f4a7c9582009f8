#pragma once

#include "engine/model/load.hpp"

#include <optional>
#include <span>

namespace spheroscope {

/// The hull's faces that are left out: all whose middle is nearer to a line than this radius, on
/// the side that `towards` points to from `centre`.
struct HullOpening {
    Vec3 centre_um;
    Vec3 towards;  ///< unit, along the line
    double radius_um;
};

/// The convex hull of these points (Barber, Dobkin and Huhdanpaa, ACM Trans. Math. Softw. 22, 1996,
/// 469: the library Qhull), each plane moved outward by `gap_um`, open where `opening` says.
/// Throws Error when the points have no hull: fewer than four, or all in a plane.
[[nodiscard]] Hull make_convex_hull(std::span<const Vec3> points_um, double gap_um,
                                    const HullOpening& opening);

/// A point that is outside of the planes, and by how much.
struct PointOutside {
    std::size_t point;
    double distance_um;
};
/// The one farthest outside; nothing if the hull contains them all.
[[nodiscard]] std::optional<PointOutside> find_outside(const Hull& hull,
                                                       std::span<const Vec3> points_um);

}  // namespace spheroscope
