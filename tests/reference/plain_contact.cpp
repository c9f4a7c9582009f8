#include "tests/reference/plain_contact.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

namespace spheroscope::reference {
namespace {

using Real = long double;
using Real3 = Eigen::Matrix<Real, 3, 1>;

/// A point of the contact plane: its two coordinates, and the overlap of the surfaces there.
struct Corner {
    Real u, v, overlap;
};
using Polygon = std::vector<Corner>;

/// Keeps the side where value(corner) >= 0; everything a corner carries is affine.
template <class Value> Polygon kept_side(const Polygon& polygon, const Value& value) {
    Polygon kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Corner& p = polygon[i];
        const Corner& q = polygon[(i + 1) % polygon.size()];
        const Real at_p = value(p), at_q = value(q);
        if (at_p >= 0) kept.push_back(p);
        if ((at_p >= 0) == (at_q >= 0)) continue;
        const Real t = at_p / (at_p - at_q);
        kept.push_back({(1 - t) * p.u + t * q.u, (1 - t) * p.v + t * q.v,
                        (1 - t) * p.overlap + t * q.overlap});
    }
    return kept;
}

/// Integrals over a polygon of the products of two of (1, u, v).
struct Moments {
    Real one = 0, u = 0, v = 0, uu = 0, uv = 0, vv = 0;
};

/// Green's theorem, one term for each side; the sign is that of the polygon's winding.
Moments moments_of(const Polygon& polygon) {
    Moments m;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Corner& p = polygon[i];
        const Corner& q = polygon[(i + 1) % polygon.size()];
        const Real cross = p.u * q.v - q.u * p.v;
        m.one += cross / 2;
        m.u += cross * (p.u + q.u) / 6;
        m.v += cross * (p.v + q.v) / 6;
        m.uu += cross * (p.u * p.u + p.u * q.u + q.u * q.u) / 12;
        m.vv += cross * (p.v * p.v + p.v * q.v + q.v * q.v) / 12;
        m.uv += cross * (p.u * q.v + 2 * p.u * p.v + 2 * q.u * q.v + q.u * p.v) / 24;
    }
    return m;
}

Real determinant(const Real3& a, const Real3& b, const Real3& c) { return a.dot(b.cross(c)); }

}  // namespace

PlainContact plain_contact(const std::array<Vec3, 3>& a_um, const std::array<Vec3, 3>& b_um,
                           const ContactLaw& law) {
    std::array<Real3, 3> a, b;
    for (std::size_t i = 0; i < 3; ++i) {
        a[i] = a_um[i].cast<Real>();
        b[i] = b_um[i].cast<Real>();
    }
    const Real3 n_a = (a[1] - a[0]).cross(a[2] - a[0]).normalized();
    const Real3 n_b = (b[1] - b[0]).cross(b[2] - b[0]).normalized();
    const Real c = (n_b - n_a).norm() / 2;
    const Real3 n = (n_b - n_a).normalized();
    const Real3 e1 = n.unitOrthogonal();
    const Real3 e2 = n.cross(e1);

    const auto on_plane = [&](const Real3& x) {
        const Real3 r = x - a[0];
        const Real u = e1.dot(r), v = e2.dot(r);
        const Real3 flat = a[0] + u * e1 + v * e2;
        // Heights over this point at which a line along n meets the two triangles' planes.
        const Real height_a = n_a.dot(a[0] - flat) / n_a.dot(n);
        const Real height_b = n_b.dot(b[0] - flat) / n_b.dot(n);
        // Moving a surface out by h0 along its own normal moves it by h0/c along n.
        return Corner{u, v, height_b - height_a + 2 * static_cast<Real>(law.h0_um) / c};
    };
    std::array<Corner, 3> pa, pb;
    for (std::size_t i = 0; i < 3; ++i) {
        pa[i] = on_plane(a[i]);
        pb[i] = on_plane(b[i]);
    }
    Polygon polygon(pa.begin(), pa.end());
    for (std::size_t i = 0; i < 3; ++i) {
        const Corner& p = pb[i];
        const Corner& q = pb[(i + 1) % 3];
        const Corner& inside = pb[(i + 2) % 3];
        const auto side = [&](const Corner& x) {
            return (q.u - p.u) * (x.v - p.v) - (q.v - p.v) * (x.u - p.u);
        };
        const Real sign = side(inside) > 0 ? 1 : -1;
        polygon = kept_side(polygon, [&](const Corner& x) { return sign * side(x); });
    }
    polygon = kept_side(polygon, [](const Corner& x) { return x.overlap; });

    PlainContact result;
    result.normal = n.cast<double>();
    Moments m = moments_of(polygon);
    if (m.one < 0) m = {-m.one, -m.u, -m.v, -m.uu, -m.uv, -m.vv};
    if (polygon.size() < 3 || m.one == 0) return result;
    result.touches = true;

    // The overlap as an affine function, from its values at three corners of A.
    const Real3 ones = Real3::Ones();
    const Real3 us(pa[0].u, pa[1].u, pa[2].u), vs(pa[0].v, pa[1].v, pa[2].v);
    const Real3 overlaps(pa[0].overlap, pa[1].overlap, pa[2].overlap);
    const Real det_a = determinant(ones, us, vs);
    const Real d0 = determinant(overlaps, us, vs) / det_a;
    const Real du = determinant(ones, overlaps, vs) / det_a;
    const Real dv = determinant(ones, us, overlaps) / det_a;

    const Real k = static_cast<Real>(law.k_kPa_per_um), P0 = static_cast<Real>(law.P0_kPa);
    const Real mean_times_area = d0 * m.one + du * m.u + dv * m.v;
    const Real force = k * mean_times_area - P0 * m.one;
    const Real moment_u = k * (d0 * m.u + du * m.uu + dv * m.uv) - P0 * m.u;
    const Real moment_v = k * (d0 * m.v + du * m.uv + dv * m.vv) - P0 * m.v;
    const Real square = d0 * d0 * m.one + 2 * d0 * (du * m.u + dv * m.v) + du * du * m.uu +
                        2 * du * dv * m.uv + dv * dv * m.vv;
    result.area_um2 = static_cast<double>(m.one);
    result.force_nN = static_cast<double>(force);
    result.energy_fJ = static_cast<double>(k / 2 * square - P0 * mean_times_area);
    result.overlap_um = static_cast<double>(mean_times_area / m.one);
    result.first_moment_nN_um = (moment_u * e1 + moment_v * e2).cast<double>();

    // The contact plane lies midway between the two moved surfaces, seen along n.
    const Real u = m.u / m.one, v = m.v / m.one;
    const Real3 flat = a[0] + u * e1 + v * e2;
    const Real middle = (n_a.dot(a[0] - flat) / n_a.dot(n) + n_b.dot(b[0] - flat) / n_b.dot(n)) / 2;
    result.centroid_um = (flat + middle * n).cast<double>();

    // (7): sum f = F, sum f u = M_u, sum f v = M_v.
    const auto solve = [&](const std::array<Corner, 3>& corner, std::array<double, 3>& f) {
        std::array<Real3, 3> column;
        for (std::size_t i = 0; i < 3; ++i) column[i] = Real3(1, corner[i].u, corner[i].v);
        const Real3 right(force, moment_u, moment_v);
        const Real det = determinant(column[0], column[1], column[2]);
        f[0] = static_cast<double>(determinant(right, column[1], column[2]) / det);
        f[1] = static_cast<double>(determinant(column[0], right, column[2]) / det);
        f[2] = static_cast<double>(determinant(column[0], column[1], right) / det);
    };
    solve(pa, result.force_a_nN);
    solve(pb, result.force_b_nN);
    return result;
}

}  // namespace spheroscope::reference
