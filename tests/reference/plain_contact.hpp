#pragma once

#include "engine/base/vec3.hpp"
#include "engine/contact/contact_law.hpp"

#include <array>

namespace spheroscope::reference {

/// What the contact kernel should find, from the definitions of Cuvelier et al. 2021, eqns (5)-(7),
/// and nothing else: no early exits, no moved origin, long double.
struct PlainContact {
    bool touches = false;  ///< the clip polygon has an area
    double area_um2 = 0.0;
    double force_nN = 0.0;
    double energy_fJ = 0.0;
    double overlap_um = 0.0;  ///< mean over the polygon
    Vec3 normal = Vec3::Zero();
    Vec3 centroid_um = Vec3::Zero();
    Vec3 first_moment_nN_um = Vec3::Zero();  ///< in-plane integral of P (x - a_0)
    std::array<double, 3> force_a_nN{}, force_b_nN{};
};

/// Sutherland-Hodgman clip in the contact plane, overlap from the heights of both triangles over
/// it, closed-form polygon moments (Green's theorem), nodal forces by Cramer's rule on the 3x3
/// system (7). Corners counter-clockwise from outside. Ignores reject_cos and largest_overlap_um of
/// the law.
[[nodiscard]] PlainContact plain_contact(const std::array<Vec3, 3>& a_um,
                                         const std::array<Vec3, 3>& b_um, const ContactLaw& law);

}  // namespace spheroscope::reference
