#include "engine/forces/nearest_inside.hpp"

namespace spheroscope {
namespace {

/// A point is outside of a plane that it is farther beyond: a thousand times what rounding makes of
/// coordinates of some 100 um.
constexpr double k_outside_um = 1e-10;
/// Sine below which two planes are one: their normals are known to 1e-16.
constexpr double k_parallel = 1e-10;

double beyond_um(const Hull::Plane& plane, const Vec3& x_um) {
    return plane.normal.dot(x_um) - plane.offset_um;
}

/// Nearest point that is inside of these planes and on those that `start` lies on, of which it is
/// the nearest point if there are no others.
NearestInside nearest(std::span<const Hull::Plane* const> planes, const NearestInside& start) {
    NearestInside found = start;
    if (start.n_across == 3) return found;  // there is only one such point
    for (std::size_t i = 0; i < planes.size(); ++i) {
        if (!(beyond_um(*planes[i], found.point_um) > k_outside_um)) continue;
        // What the normal has along the planes that the point has to stay on.
        Vec3 free = planes[i]->normal;
        for (int k = 0; k < start.n_across; ++k) {
            const Vec3& across = start.across[static_cast<std::size_t>(k)];
            free -= across.dot(free) * across;
        }
        const double slope = free.norm();
        if (slope < k_parallel) continue;  // one of them once more
        NearestInside on_plane = start;
        const Vec3 direction = free / slope;
        on_plane.across[static_cast<std::size_t>(on_plane.n_across++)] = direction;
        on_plane.point_um -= beyond_um(*planes[i], start.point_um) / slope * direction;
        found = nearest(planes.first(i), on_plane);
    }
    return found;
}

}  // namespace

NearestInside nearest_inside(std::span<const Hull::Plane* const> planes, const Vec3& x_um) {
    return nearest(planes, NearestInside{.point_um = x_um, .across = {}, .n_across = 0});
}

}  // namespace spheroscope
