#pragma once

#include "engine/contact/contact_law.hpp"
#include "engine/contact/contacts.hpp"

#include <array>
#include <vector>

namespace spheroscope {

/// A triangle as the contact kernel reads it: corners counter-clockwise from outside, unit normal.
struct TriangleGeometry {
    std::array<Vec3, 3> corner_um;
    Vec3 normal;
};

enum class PairOutcome {
    apart,     ///< no overlap
    active,    ///< `pair` is filled
    too_deep,  ///< overlap beyond ContactLaw::largest_overlap_um: not a contact, counted
};

/// Contact of two triangles, eqns (5)-(7), in the paper's normal-only form.
///
///   n_A  \   wedge   / n_B        Both planes are moved outward by h0. The contact plane bisects
///    _____\_________/_____        the wedge between them (the mid-plane if they are parallel); its
///     B    \       /    A         normal is n = (n_B - n_A)/|n_B - n_A|, from B to A.
///           \     /
///
/// The overlap along n is affine in the contact plane: delta(x) = [o_A + o_B - (n_A + n_B).x] / c
/// with o = n.corner + h0 and c = |n_B - n_A| / 2: the same function as the printed 2 (x-s).(n x I)
/// tan(theta), but regular for parallel triangles. The pressure P(delta) acts on the polygon in
/// which both triangles, projected along n, and delta >= 0 meet. Everything integrated is at most
/// quadratic on that polygon, so its six moments (1, x, y, xx, xy, yy) give exact integrals.
///
/// The nodal forces f_i = integral of P lambda_i (lambda: barycentric coordinates of the projected
/// triangle) are the unique solution of (7): they have the resultant and the first moment of P.
/// Both triangles get parallel forces with the same resultant and moment, so the pair's net force
/// and torque vanish.
[[nodiscard]] PairOutcome contact_of_triangles(const TriangleGeometry& a, const TriangleGeometry& b,
                                               const ContactLaw& law, ContactPair& pair);

/// Where contact_of_triangles integrates, for those who look at it.
struct ContactPolygon {
    struct Corner {
        Vec3 x_um;  ///< half-way between the two surfaces
        double overlap_um;
    };
    Vec3 normal = Vec3::Zero();
    std::vector<Corner> corners;     ///< empty where the triangles are apart
    std::vector<Corner> quadrature;  ///< edge mid-points of the fan of triangles, three for each
};
[[nodiscard]] ContactPolygon contact_polygon(const TriangleGeometry& a, const TriangleGeometry& b,
                                             const ContactLaw& law);

}  // namespace spheroscope
