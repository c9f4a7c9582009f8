#include "engine/contact/triangle_pair.hpp"

#include "engine/contact/pair_limits.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

namespace spheroscope {
namespace {

struct Point {
    double x, y;
};

/// Two projected triangles and one more half-plane: a triangle gains at most one corner per cut.
struct Polygon {
    std::array<Point, 8> corner;
    std::size_t n = 0;
};

/// Keeps the part where f(p) = f0 + fx x + fy y >= 0 (Sutherland and Hodgman 1974).
void clip(Polygon& polygon, double f0, double fx, double fy) {
    Polygon kept;
    for (std::size_t i = 0; i < polygon.n; ++i) {
        const Point& p = polygon.corner[i];
        const Point& q = polygon.corner[i + 1 == polygon.n ? 0 : i + 1];
        const double fp = f0 + fx * p.x + fy * p.y;
        const double fq = f0 + fx * q.x + fy * q.y;
        if (fp >= 0.0) kept.corner[kept.n++] = p;
        if ((fp >= 0.0) != (fq >= 0.0)) {
            const double t = fp / (fp - fq);
            kept.corner[kept.n++] = {p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)};
        }
    }
    polygon = kept;
}

/// Barycentric coordinates as affine functions: lambda_i(p) = at_origin[i] + x[i] p.x + y[i] p.y.
struct Barycentric {
    std::array<double, 3> at_origin, x, y;
    double twice_area;  // signed

    explicit Barycentric(const std::array<Point, 3>& p)
        : at_origin{}, x{}, y{}, twice_area((p[1].x - p[0].x) * (p[2].y - p[0].y) -
                                            (p[2].x - p[0].x) * (p[1].y - p[0].y)) {
        for (std::size_t i = 0; i < 3; ++i) {
            const Point& q = p[(i + 1) % 3];
            const Point& r = p[(i + 2) % 3];
            x[i] = (q.y - r.y) / twice_area;
            y[i] = (r.x - q.x) / twice_area;
            at_origin[i] = (q.x * r.y - r.x * q.y) / twice_area;
        }
    }
    [[nodiscard]] double value(std::size_t i, double s, double sx, double sy) const {
        return at_origin[i] * s + x[i] * sx + y[i] * sy;
    }
};

struct Moments {
    double s = 0, sx = 0, sy = 0, sxx = 0, sxy = 0, syy = 0;
};

/// Integrals of 1, x, y, xx, xy, yy: fan of triangles, each by its three edge mid-points.
Moments moments_of(const Polygon& polygon) {
    Moments m;
    const Point& p = polygon.corner[0];
    for (std::size_t i = 1; i + 1 < polygon.n; ++i) {
        const Point& q = polygon.corner[i];
        const Point& r = polygon.corner[i + 1];
        const double area = 0.5 * std::abs((q.x - p.x) * (r.y - p.y) - (r.x - p.x) * (q.y - p.y));
        const double w = area / 3.0;
        m.s += area;
        for (const Point& mid : {Point{0.5 * (p.x + q.x), 0.5 * (p.y + q.y)},
                                 Point{0.5 * (q.x + r.x), 0.5 * (q.y + r.y)},
                                 Point{0.5 * (r.x + p.x), 0.5 * (r.y + p.y)}}) {
            m.sx += w * mid.x;
            m.sy += w * mid.y;
            m.sxx += w * mid.x * mid.x;
            m.sxy += w * mid.x * mid.y;
            m.syy += w * mid.y * mid.y;
        }
    }
    return m;
}

/// The contact plane of two triangles and what is cut out of it.
struct Clipped {
    Vec3 origin, e1, e2, normal;  ///< a corner of A; a frame of the plane
    double d0, dx, dy;            ///< delta = d0 + dx x + dy y
    Barycentric lambda, mu;       ///< of A and B, projected
    Polygon polygon;
    [[nodiscard]] double overlap_at(const Point& p) const { return d0 + dx * p.x + dy * p.y; }
};

/// Empty where the triangles are apart, seen edge-on, or rejected for their angle.
std::optional<Clipped> clip_pair(const TriangleGeometry& a, const TriangleGeometry& b,
                                 const ContactLaw& law) {
    if (a.normal.dot(b.normal) >= law.reject_cos) return {};
    const Vec3 m = b.normal - a.normal;
    const double m_length = m.norm();
    const double c = 0.5 * m_length;
    const Vec3 n = m / m_length;

    // All positions are relative to a corner of A: nothing cancels far from the world's origin.
    const Vec3& origin = a.corner_um[0];
    const double o_a = law.h0_um;
    const double o_b = b.normal.dot(b.corner_um[0] - origin) + law.h0_um;

    // A frame in the contact plane: e1 across the largest component of n.
    const std::size_t axis = std::abs(n.x()) < std::abs(n.y()) ? 0U : 1U;
    const Vec3 e1 = (axis == 0 ? Vec3(0.0, -n.z(), n.y()) : Vec3(n.z(), 0.0, -n.x())).normalized();
    const Vec3 e2 = n.cross(e1);
    const auto project = [&](const Vec3& x) {
        const Vec3 r = x - origin;
        return Point{e1.dot(r), e2.dot(r)};
    };
    const std::array<Point, 3> pa{project(a.corner_um[0]), project(a.corner_um[1]),
                                  project(a.corner_um[2])};
    const std::array<Point, 3> pb{project(b.corner_um[0]), project(b.corner_um[1]),
                                  project(b.corner_um[2])};
    const auto [ax0, ax1] = std::minmax({pa[0].x, pa[1].x, pa[2].x});
    const auto [bx0, bx1] = std::minmax({pb[0].x, pb[1].x, pb[2].x});
    if (ax0 > bx1 || bx0 > ax1) return {};
    const auto [ay0, ay1] = std::minmax({pa[0].y, pa[1].y, pa[2].y});
    const auto [by0, by1] = std::minmax({pb[0].y, pb[1].y, pb[2].y});
    if (ay0 > by1 || by0 > ay1) return {};

    // delta = d0 + dx x + dy y; (n_A + n_B).n = 0, so the plane's offset along n does not enter.
    const Vec3 sum = a.normal + b.normal;
    const double d0 = (o_a + o_b) / c;
    const double dx = -sum.dot(e1) / c;
    const double dy = -sum.dot(e2) / c;
    const auto overlap_at = [&](const Point& p) { return d0 + dx * p.x + dy * p.y; };
    if (overlap_at(pa[0]) < 0.0 && overlap_at(pa[1]) < 0.0 && overlap_at(pa[2]) < 0.0) return {};

    const Barycentric lambda(pa), mu(pb);
    // Seen against n, B (outward along n) runs counter-clockwise and A clockwise.
    const double smallest =
        k_edge_on * std::max(std::abs(lambda.twice_area), std::abs(mu.twice_area));
    if (-lambda.twice_area <= smallest || mu.twice_area <= smallest) return {};

    Polygon polygon;
    polygon.n = 3;
    std::copy(pa.begin(), pa.end(), polygon.corner.begin());
    for (std::size_t k = 0; k < 3 && polygon.n > 0; ++k)
        clip(polygon, mu.at_origin[k], mu.x[k], mu.y[k]);
    if (polygon.n > 0) clip(polygon, d0, dx, dy);
    if (polygon.n < 3) return {};

    return Clipped{origin, e1, e2, n, d0, dx, dy, lambda, mu, polygon};
}

}  // namespace

PairOutcome contact_of_triangles(const TriangleGeometry& a, const TriangleGeometry& b,
                                 const ContactLaw& law, ContactPair& pair) {
    const std::optional<Clipped> clipped = clip_pair(a, b, law);
    if (!clipped) return PairOutcome::apart;
    const auto& [origin, e1, e2, n, d0, dx, dy, lambda, mu, polygon] = *clipped;
    const Moments s = moments_of(polygon);
    if (s.s < k_smallest_polygon_um2) return PairOutcome::apart;
    const double overlap_um = d0 + (dx * s.sx + dy * s.sy) / s.s;
    if (overlap_um > law.largest_overlap_um) return PairOutcome::too_deep;

    // P = p0 + px x + py y, its resultant and first moment.
    const double p0 = law.k_kPa_per_um * d0 - law.P0_kPa;
    const double px = law.k_kPa_per_um * dx;
    const double py = law.k_kPa_per_um * dy;
    const double force = p0 * s.s + px * s.sx + py * s.sy;
    const double force_x = p0 * s.sx + px * s.sxx + py * s.sxy;
    const double force_y = p0 * s.sy + px * s.sxy + py * s.syy;
    for (std::size_t i = 0; i < 3; ++i) {
        pair.force_a_nN[i] = lambda.value(i, force, force_x, force_y);
        pair.force_b_nN[i] = mu.value(i, force, force_x, force_y);
        pair.lambda[i] = lambda.value(i, 1.0, s.sx / s.s, s.sy / s.s);
        pair.mu[i] = mu.value(i, 1.0, s.sx / s.s, s.sy / s.s);
    }
    const double overlap2 = d0 * d0 * s.s + 2.0 * d0 * (dx * s.sx + dy * s.sy) + dx * dx * s.sxx +
                            2.0 * dx * dy * s.sxy + dy * dy * s.syy;
    pair.energy_fJ = 0.5 * law.k_kPa_per_um * overlap2 - law.P0_kPa * overlap_um * s.s;
    double largest_um = overlap_um;
    for (std::size_t i = 0; i < polygon.n; ++i)
        largest_um = std::max(largest_um, clipped->overlap_at(polygon.corner[i]));
    pair.overlap_um = static_cast<float>(overlap_um);
    pair.largest_overlap_um = static_cast<float>(largest_um);
    pair.area_um2 = s.s;
    pair.normal = n;
    return PairOutcome::active;
}

ContactPolygon contact_polygon(const TriangleGeometry& a, const TriangleGeometry& b,
                               const ContactLaw& law) {
    ContactPolygon result;
    const std::optional<Clipped> clipped = clip_pair(a, b, law);
    if (!clipped) return result;
    result.normal = clipped->normal;
    // Heights of both planes along n; the polygon is shown half-way between them.
    const double along_a = a.normal.dot(clipped->normal), along_b = b.normal.dot(clipped->normal);
    const auto point = [&](const Point& p) -> ContactPolygon::Corner {
        const Vec3 in_plane = p.x * clipped->e1 + p.y * clipped->e2;
        const double height_a = -a.normal.dot(in_plane) / along_a;
        const double height_b = b.normal.dot(b.corner_um[0] - clipped->origin - in_plane) / along_b;
        return {clipped->origin + in_plane + 0.5 * (height_a + height_b) * clipped->normal,
                clipped->overlap_at(p)};
    };
    const Polygon& polygon = clipped->polygon;
    for (std::size_t i = 0; i < polygon.n; ++i) result.corners.push_back(point(polygon.corner[i]));
    const auto middle = [](const Point& p, const Point& q) {
        return Point{0.5 * (p.x + q.x), 0.5 * (p.y + q.y)};
    };
    const Point& p = polygon.corner[0];
    for (std::size_t i = 1; i + 1 < polygon.n; ++i) {
        const Point &q = polygon.corner[i], &r = polygon.corner[i + 1];
        for (const Point& mid : {middle(p, q), middle(q, r), middle(r, p)})
            result.quadrature.push_back(point(mid));
    }
    return result;
}

}  // namespace spheroscope
