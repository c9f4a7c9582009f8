// The contact of one pair of triangles per lane: contact_of_triangles, step by step, on vectors.
// Included once for each SIMD target.

#if defined(SPHEROSCOPE_PAIR_CLIP_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SPHEROSCOPE_PAIR_CLIP_INL
#undef SPHEROSCOPE_PAIR_CLIP_INL
#else
#define SPHEROSCOPE_PAIR_CLIP_INL
#endif

#include "engine/contact/pair_lanes.hpp"
#include "engine/contact/pair_limits.hpp"
#include "engine/contact/pair_polygon-inl.hpp"
#include "engine/contact/pair_records-inl.hpp"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace spheroscope::lanes {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// The plane that bisects the wedge between the two triangles' planes: its unit normal n, a frame
/// e1, e2, and delta, the overlap along n.
template <class V> struct ContactPlane {
    Point3<V> n, e1, e2;
    Overlap<V> overlap;
};

/// As in contact_of_triangles. e1 is at right angles to the x or the y axis, whichever n is farther
/// from: the length that it is divided by is not small.
template <class D, class V = hn::Vec<D>>
HWY_INLINE ContactPlane<V> contact_plane(D d, const TrianglePair<V>& pair, hn::TFromD<D> h0) {
    using T = hn::TFromD<D>;
    const V zero = hn::Zero(d);
    const Point3<V>&n_a = pair.normal_a, &n_b = pair.normal_b;
    Point3<V> n{n_b.x - n_a.x, n_b.y - n_a.y, n_b.z - n_a.z};
    const V m_length = hn::Sqrt(dot(n, n));
    const V c = hn::Set(d, static_cast<T>(0.5)) * m_length;
    n = {n.x / m_length, n.y / m_length, n.z / m_length};
    const auto across_x = hn::Lt(hn::Abs(n.x), hn::Abs(n.y));
    const V other = hn::IfThenElse(across_x, n.y, n.x);
    const V length = hn::Sqrt(hn::MulAdd(n.z, n.z, other * other));
    const V u = n.z / length, w = other / length;
    const Point3<V> e1{hn::IfThenElse(across_x, zero, u),
                       hn::IfThenElse(across_x, hn::Neg(u), zero),
                       hn::IfThenElse(across_x, w, hn::Neg(w))};
    const Point3<V> e2 = cross(n, e1);
    const Point3<V> sum{n_a.x + n_b.x, n_a.y + n_b.y, n_a.z + n_b.z};
    const V two_h0 = hn::Set(d, h0 + h0);
    return {
        n,
        e1,
        e2,
        {(two_h0 + dot(n_b, pair.b[0])) / c, hn::Neg(dot(sum, e1)) / c, hn::Neg(dot(sum, e2)) / c}};
}

/// A^p and B^p.
template <class V> struct FlatPair {
    FlatTriangle<V> a, b;
    V extent;  ///< largest coordinate of a corner
};

/// Both projections counter-clockwise, seen against n: A is turned round, its corner 1 is the
/// pair's corner 2.
template <class D, class V = hn::Vec<D>>
HWY_INLINE FlatPair<V> projected(D d, const TrianglePair<V>& pair, const ContactPlane<V>& plane) {
    const V zero = hn::Zero(d);
    const Point3<V>&e1 = plane.e1, &e2 = plane.e2;
    const Point2<V> a[3]{{zero, zero},
                         {dot(e1, pair.a[2]), dot(e2, pair.a[2])},
                         {dot(e1, pair.a[1]), dot(e2, pair.a[1])}};
    Point2<V> b[3];
    V extent = hn::Max(hn::Max(hn::Abs(a[1].x), hn::Abs(a[1].y)),
                       hn::Max(hn::Abs(a[2].x), hn::Abs(a[2].y)));
    for (int i = 0; i < 3; ++i) {
        b[i] = {dot(e1, pair.b[i]), dot(e2, pair.b[i])};
        extent = hn::Max(extent, hn::Max(hn::Abs(b[i].x), hn::Abs(b[i].y)));
    }
    return {on_grid(d, a, extent, plane.overlap), on_grid(d, b, extent, plane.overlap), extent};
}

template <class D> HWY_INLINE std::uint64_t bits_of(D d, hn::Mask<D> mask) {
    alignas(8) std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, mask, bits);
    return static_cast<std::uint64_t>(bits[0]) | static_cast<std::uint64_t>(bits[1]) << 8U;
}

/// A barycentric coordinate as an affine function of the position relative to an origin.
template <class V> struct Barycentric {
    V at_origin, x, y;
    /// Of a quantity with the resultant s and the first moments sx, sy: the corner's part.
    HWY_INLINE V value(V s, V sx, V sy) const {
        return hn::MulAdd(at_origin, s, hn::MulAdd(x, sx, y * sy));
    }
};

/// That of the corner opposite to edge i.
template <class D, class V = hn::Vec<D>> HWY_INLINE Barycentric<V>
barycentric(D d, const FlatTriangle<V>& t, int i, V twice_area, const Point2<V>& origin) {
    const Point2<V>& e = t.edge[i];
    return {cross(d, e, origin - t.corner[i]) / twice_area, hn::Neg(e.y) / twice_area,
            e.x / twice_area};
}

/// The resultant and the first moments of the pressure, which is linear, P = k delta - P0; and its
/// energy.
template <class V> struct PressureIntegrals { V force, force_x, force_y, energy; };

/// m, overlap: about the same origin.
template <class D, class V = hn::Vec<D>>
HWY_INLINE PressureIntegrals<V> integrated_pressure(D d, const Task<hn::TFromD<D>>& task,
                                                    const Moments<V>& m, const Overlap<V>& overlap,
                                                    V mean_overlap) {
    using T = hn::TFromD<D>;
    const auto& [d0, dx, dy] = overlap;
    const V k = hn::Set(d, task.k), P0 = hn::Set(d, task.P0), two = hn::Set(d, 2);
    const V p0 = hn::MulSub(k, d0, P0), px = k * dx, py = k * dy;
    const V slope = hn::MulAdd(dx, m.sx, dy * m.sy);
    const V overlap2 =
        hn::MulAdd(d0, hn::MulAdd(d0, m.s, two * slope),
                   hn::MulAdd(dx * dx, m.sxx, hn::MulAdd(two * dx * dy, m.sxy, dy * dy * m.syy)));
    return {hn::MulAdd(p0, m.s, hn::MulAdd(px, m.sx, py * m.sy)),
            hn::MulAdd(p0, m.sx, hn::MulAdd(px, m.sxx, py * m.sxy)),
            hn::MulAdd(p0, m.sy, hn::MulAdd(px, m.sxy, py * m.syy)),
            hn::MulSub(hn::Set(d, static_cast<T>(0.5)) * k, overlap2, P0 * mean_overlap * m.s)};
}

/// Clips the pairs (triangle_a, triangle_b) of the batch, one in each lane.
template <class D>
HWY_NOINLINE void clip_pairs(D d, const Task<hn::TFromD<D>>& task, Batch<hn::TFromD<D>>& out) {
    using T = hn::TFromD<D>;
    using V = hn::Vec<D>;
    using M = hn::Mask<D>;
    const V zero = hn::Zero(d), one = hn::Set(d, 1);

    const TrianglePair<V> pair = loaded_pair(d, task, out.triangle_a, out.triangle_b);
    const ContactPlane<V> plane = contact_plane(d, pair, task.h0);
    const FlatPair<V> flat = projected(d, pair, plane);
    const Polygon<D> polygon = common_polygon(d, flat.a, flat.b);
    const SegmentEnds<V> ends = segment_ends(d, polygon);
    const Point2<V> origin = moment_origin(d, ends, polygon.is_cut, flat.extent, plane.overlap);
    const Overlap<V> overlap = plane.overlap.about(origin);
    const Moments<V> m = moments_about(d, polygon, origin);

    // Same limits as in contact_of_triangles.
    const V twice_a = twice_area(d, flat.a), twice_b = twice_area(d, flat.b);
    const V smallest =
        hn::Set(d, static_cast<T>(k_edge_on)) * hn::Max(hn::Abs(twice_a), hn::Abs(twice_b));
    const M is_seen = hn::And(hn::Gt(twice_a, smallest), hn::Gt(twice_b, smallest));
    const M touches = hn::And(hn::And(hn::Gt(ends.n_segments, zero), is_seen),
                              hn::Ge(m.s, hn::Set(d, static_cast<T>(k_smallest_polygon_um2))));
    const Point2<V> centroid{m.sx / m.s, m.sy / m.s};
    const V mean_overlap = overlap.at(centroid);
    const M is_deep = hn::Gt(mean_overlap, hn::Set(d, task.largest_overlap));
    out.active = bits_of(d, hn::AndNot(is_deep, touches));
    out.too_deep = bits_of(d, hn::And(is_deep, touches));
    if (out.active == 0) return;

    const PressureIntegrals<V> p = integrated_pressure(d, task, m, overlap, mean_overlap);
    // Corner 0 is opposite to the edge 1 -> 2; corner 1 of A, which is turned, to 0 -> 1.
    const Barycentric<V> a0 = barycentric(d, flat.a, 1, twice_a, origin);
    const Barycentric<V> a1 = barycentric(d, flat.a, 0, twice_a, origin);
    const Barycentric<V> b0 = barycentric(d, flat.b, 1, twice_b, origin);
    const Barycentric<V> b1 = barycentric(d, flat.b, 2, twice_b, origin);
    const auto store = [&](Value v, V value) HWY_ATTR { hn::StoreU(value, d, out.value[v]); };
    store(Value::normal_x, plane.n.x);
    store(Value::normal_y, plane.n.y);
    store(Value::normal_z, plane.n.z);
    store(Value::area, m.s);
    store(Value::force, p.force);
    store(Value::force_a0, a0.value(p.force, p.force_x, p.force_y));
    store(Value::force_a1, a1.value(p.force, p.force_x, p.force_y));
    store(Value::force_b0, b0.value(p.force, p.force_x, p.force_y));
    store(Value::force_b1, b1.value(p.force, p.force_x, p.force_y));
    store(Value::lambda0, a0.value(one, centroid.x, centroid.y));
    store(Value::lambda1, a1.value(one, centroid.x, centroid.y));
    store(Value::mu0, b0.value(one, centroid.x, centroid.y));
    store(Value::mu1, b1.value(one, centroid.x, centroid.y));
    store(Value::energy, p.energy);
    store(Value::overlap, mean_overlap);
    store(Value::largest_overlap, hn::Max(ends.largest_overlap, mean_overlap));
}

}  // namespace HWY_NAMESPACE
}  // namespace spheroscope::lanes
HWY_AFTER_NAMESPACE();

#endif
