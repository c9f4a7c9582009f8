#pragma once

#include "engine/base/vec3.hpp"
#include "engine/run/snapshot.hpp"

#include <span>

namespace spheroscope::test {

struct Sphere {
    Vec3 centre_um;
    double radius_um;
};

/// Least-squares sphere (Coope 1993): linear in the centre and in R^2 - |c|^2. At least four points
/// that do not lie in one plane.
[[nodiscard]] Sphere fit_sphere(std::span<const Vec3> points_um);

/// Two equal cells that stick together are two spherical caps on one disc:
///
///       .--.  .--.
///      (  c | c'  )      theta: between the cap and the disc; cos theta = h / R with h from a
///      cap's
///       '--'  '--'       centre to the mid-plane and R the cap's radius. The disc's area is
///                        pi (R^2 - h^2).
///
/// Caps are fitted to the 55 % of each cell's nodes that are farthest from the mid-plane, which
/// lies half way between the means of the two cells' nodes. Values are means of the two cells.
struct DoubletShape {
    double cos_theta;
    double cap_radius_um;
    double disc_area_um2;
    double clip_area_um2;  ///< sum of S_AB: where the law of contact acts, the rim included
};

/// Precondition: a snapshot of two cells in contact.
[[nodiscard]] DoubletShape doublet_shape(const Snapshot& snapshot);

}  // namespace spheroscope::test
