// The clip of one pair of triangles per lane. Included once for each SIMD target.
//
// Sutherland and Hodgman's polygon has a different number of corners in every lane. Here the
// boundary of the polygon is taken as a set of segments in no order: what B^p leaves of the three
// edges of A^p and what A^p leaves of those of B^p (Cyrus and Beck 1978), each cut by delta >= 0.
// Green's theorem sums them to the moments. Three things make that safe:
//
//  - All projected corners are moved to a grid of 2^-22 of their extent. Differences of corners are
//    then exact, and a cross product of two differences, from two fused products (Kahan), has the
//    right sign and 24 right digits. So both triangles agree on which corner lies on which side,
//    however small the angle between two edges is, and an edge that both have is counted once: it
//    is inside for A^p (>= 0) and outside for B^p (> 0).
//  - The line delta = 0 is the polygon's last side. It is never made: moments are taken about a
//    point on this line, where its part of the integrals is zero.
//  - Otherwise they are taken about the middle of the segments' ends, so that small polygons keep
//    their digits.

#if defined(SPHEROSCOPE_PAIR_CLIP_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SPHEROSCOPE_PAIR_CLIP_INL
#undef SPHEROSCOPE_PAIR_CLIP_INL
#else
#define SPHEROSCOPE_PAIR_CLIP_INL
#endif

#include "engine/contact/pair_lanes.hpp"
#include "engine/contact/pair_limits.hpp"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace spheroscope::lanes {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class V> struct Point2 { V x, y; };
template <class V> struct Point3 { V x, y, z; };

template <class V> HWY_INLINE Point2<V> operator-(const Point2<V>& p, const Point2<V>& q) {
    return {p.x - q.x, p.y - q.y};
}
template <class V> HWY_INLINE V dot(const Point3<V>& p, const Point3<V>& q) {
    return hn::MulAdd(p.x, q.x, hn::MulAdd(p.y, q.y, p.z * q.z));
}

#if !HWY_NATIVE_FMA
/// high + low = p q exactly (Dekker 1971).
template <class D, class V = hn::Vec<D>>
HWY_INLINE void exact_product(D d, V p, V q, V& high, V& low) {
    using T = hn::TFromD<D>;
    const V splitter = hn::Set(d, static_cast<T>(sizeof(T) == 4 ? 4097.0 : 134217729.0));
    const V cp = splitter * p, cq = splitter * q;
    const V p1 = cp - (cp - p), q1 = cq - (cq - q);
    const V p2 = p - p1, q2 = q - q1;
    high = p * q;
    low = ((p1 * q1 - high) + p1 * q2 + p2 * q1) + p2 * q2;
}
#endif

/// p x q = p.x q.y - p.y q.x to the last digit or two, the sign always right.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V cross(D d, const Point2<V>& p, const Point2<V>& q) {
#if HWY_NATIVE_FMA
    static_cast<void>(d);
    const V second = p.y * q.x;
    const V error = hn::NegMulAdd(p.y, q.x, second);
    return hn::MulSub(p.x, q.y, second) + error;
#else
    V a, a_low, b, b_low;
    exact_product(d, p.x, q.y, a, a_low);
    exact_product(d, p.y, q.x, b, b_low);
    return (a - b) + (a_low - b_low);
#endif
}

/// The largest power of two that is not above v > 0.
template <class D, class V = hn::Vec<D>> HWY_INLINE V power_of_two(D d, V v) {
    const hn::RebindToUnsigned<D> du;
    using U = hn::TFromD<decltype(du)>;
    const U exponent =
        sizeof(U) == 4 ? static_cast<U>(0x7F800000U) : static_cast<U>(0x7FF0000000000000ULL);
    return hn::BitCast(d, hn::And(hn::BitCast(du, v), hn::Set(du, exponent)));
}

/// A piece of the polygon's boundary; `is_there` in lanes where it is one.
template <class D> struct Segment {
    Point2<hn::Vec<D>> from, to;
    hn::Vec<D> overlap_from, overlap_to;
    hn::Mask<D> is_there;
};

/// What three half-planes, f >= 0 (f > 0 if `Open`), and delta >= 0 leave of the edge p -> p + e.
/// f0, f1: the half-planes' functions at the two ends. Sets `cut` where delta took something.
template <bool Open, class D, class V = hn::Vec<D>>
HWY_INLINE Segment<D> clip_edge(D d, const Point2<V>& p, const Point2<V>& e, const V* f0,
                                const V* f1, V overlap0, V overlap1, hn::Mask<D>& cut) {
    const V zero = hn::Zero(d), one = hn::Set(d, 1);
    V begin = zero, end = one;
    for (int k = 0; k < 3; ++k) {
        const auto out0 = Open ? hn::Le(f0[k], zero) : hn::Lt(f0[k], zero);
        const auto out1 = Open ? hn::Le(f1[k], zero) : hn::Lt(f1[k], zero);
        const V t = f0[k] / (f0[k] - f1[k]);
        // Both ends outside: begin = 1, nothing is left.
        begin = hn::IfThenElse(out0, hn::Max(begin, hn::IfThenElse(out1, one, t)), begin);
        end = hn::IfThenElse(hn::AndNot(out0, out1), hn::Min(end, t), end);
    }
    auto is_there = hn::Lt(begin, end);
    const V slope = overlap1 - overlap0;
    const V at_begin = hn::MulAdd(begin, slope, overlap0);
    const V at_end = hn::MulAdd(end, slope, overlap0);
    const auto apart_at_begin = hn::Lt(at_begin, zero), apart_at_end = hn::Lt(at_end, zero);
    const auto is_cut = hn::Or(apart_at_begin, apart_at_end);
    cut = hn::Or(cut, hn::And(is_there, is_cut));
    // Where delta is zero; between begin and end whatever the rounding.
    const V t = hn::Min(hn::Max(begin, overlap0 / (overlap0 - overlap1)), end);
    begin = hn::IfThenElse(apart_at_begin, t, begin);
    end = hn::IfThenElse(apart_at_end, t, end);
    is_there =
        hn::And(hn::AndNot(hn::And(apart_at_begin, apart_at_end), is_there), hn::Lt(begin, end));
    return {{hn::MulAdd(begin, e.x, p.x), hn::MulAdd(begin, e.y, p.y)},
            {hn::MulAdd(end, e.x, p.x), hn::MulAdd(end, e.y, p.y)},
            hn::MulAdd(begin, slope, overlap0),
            hn::MulAdd(end, slope, overlap0),
            is_there};
}

/// Integrals of 1, x, y, xx, xy, yy.
template <class V> struct Moments { V s, sx, sy, sxx, sxy, syy; };

/// Adds one side of the polygon, relative to `origin` (Green's theorem).
template <class D, class V = hn::Vec<D>>
HWY_INLINE void add_side(D d, const Segment<D>& side, const Point2<V>& origin, Moments<V>& m) {
    const Point2<V> p = side.from - origin, q = side.to - origin;
    const V w = hn::IfThenElseZero(side.is_there, hn::MulSub(p.x, q.y, p.y * q.x));
    const V px_qx = p.x + q.x, py_qy = p.y + q.y;
    m.s = m.s + w;
    m.sx = hn::MulAdd(w, px_qx, m.sx);
    m.sy = hn::MulAdd(w, py_qy, m.sy);
    m.sxx = hn::MulAdd(w, hn::MulAdd(px_qx, px_qx, hn::Neg(p.x * q.x)), m.sxx);
    m.syy = hn::MulAdd(w, hn::MulAdd(py_qy, py_qy, hn::Neg(p.y * q.y)), m.syy);
    // px qy + 2 px py + 2 qx qy + qx py = (px + qx)(py + qy) + px py + qx qy
    m.sxy = hn::MulAdd(w, hn::MulAdd(px_qx, py_qy, hn::MulAdd(p.x, p.y, q.x * q.y)), m.sxy);
    static_cast<void>(d);
}

/// A barycentric coordinate as an affine function of the position relative to an origin.
template <class V> struct Barycentric {
    V at_origin, x, y;
    HWY_INLINE V value(V s, V sx, V sy) const {
        return hn::MulAdd(at_origin, s, hn::MulAdd(x, sx, y * sy));
    }
};

/// That of the corner opposite to the edge p -> p + e.
template <class D, class V = hn::Vec<D>> HWY_INLINE Barycentric<V>
barycentric(D d, const Point2<V>& p, const Point2<V>& e, V twice_area, const Point2<V>& origin) {
    return {cross(d, e, origin - p) / twice_area, hn::Neg(e.y) / twice_area, e.x / twice_area};
}

template <class D, class VI, class V = hn::Vec<D>>
HWY_INLINE Point3<V> gathered(D d, const hn::TFromD<D>* base, VI index, std::size_t first) {
    return {hn::GatherIndex(d, base + first, index), hn::GatherIndex(d, base + first + 1, index),
            hn::GatherIndex(d, base + first + 2, index)};
}

/// Clips the pairs (index_a, index_b), positions in the records of A and B, one in each lane.
template <class D, class VI> HWY_NOINLINE void clip_pairs(D d, const Task<hn::TFromD<D>>& task,
                                                          VI index_a, VI index_b,
                                                          Batch<hn::TFromD<D>>& out) {
    using T = hn::TFromD<D>;
    using V = hn::Vec<D>;
    using M = hn::Mask<D>;
    using P = Point2<V>;
    const V zero = hn::Zero(d), one = hn::Set(d, 1);

    // Relative to a corner of A.
    const Point3<V> a0 = gathered(d, task.a.record, index_a, 0);
    const Point3<V> n_a = gathered(d, task.a.record, index_a, 9);
    const Point3<V> n_b = gathered(d, task.b.record, index_b, 9);
    const Point3<V> shift{hn::Set(d, task.offset[0]) - a0.x, hn::Set(d, task.offset[1]) - a0.y,
                          hn::Set(d, task.offset[2]) - a0.z};
    Point3<V> a[3], b[3];
    a[0] = {zero, zero, zero};
    for (std::size_t i = 1; i < 3; ++i) {
        a[i] = gathered(d, task.a.record, index_a, 3 * i);
        a[i] = {a[i].x - a0.x, a[i].y - a0.y, a[i].z - a0.z};
    }
    for (std::size_t i = 0; i < 3; ++i) {
        b[i] = gathered(d, task.b.record, index_b, 3 * i);
        b[i] = {b[i].x + shift.x, b[i].y + shift.y, b[i].z + shift.z};
    }

    // The contact plane, as in contact_of_triangles.
    Point3<V> n{n_b.x - n_a.x, n_b.y - n_a.y, n_b.z - n_a.z};
    const V m_length = hn::Sqrt(dot(n, n));
    const V c = hn::Set(d, static_cast<T>(0.5)) * m_length;
    n = {n.x / m_length, n.y / m_length, n.z / m_length};
    const M across_x = hn::Lt(hn::Abs(n.x), hn::Abs(n.y));
    const V other = hn::IfThenElse(across_x, n.y, n.x);
    const V length = hn::Sqrt(hn::MulAdd(n.z, n.z, other * other));
    const V u = n.z / length, w = other / length;
    const Point3<V> e1{hn::IfThenElse(across_x, zero, u),
                       hn::IfThenElse(across_x, hn::Neg(u), zero),
                       hn::IfThenElse(across_x, w, hn::Neg(w))};
    const Point3<V> e2{hn::MulSub(n.y, e1.z, n.z * e1.y), hn::MulSub(n.z, e1.x, n.x * e1.z),
                       hn::MulSub(n.x, e1.y, n.y * e1.x)};

    // delta = d0 + dx x + dy y
    const Point3<V> sum{n_a.x + n_b.x, n_a.y + n_b.y, n_a.z + n_b.z};
    const V two_h0 = hn::Set(d, task.h0 + task.h0);
    const V d0 = (two_h0 + dot(n_b, b[0])) / c;
    const V dx = hn::Neg(dot(sum, e1)) / c, dy = hn::Neg(dot(sum, e2)) / c;

    // Both projections counter-clockwise, seen against n; A is turned round.
    P p[3]{{zero, zero}, {dot(e1, a[2]), dot(e2, a[2])}, {dot(e1, a[1]), dot(e2, a[1])}};
    P q[3];
    V extent = hn::Max(hn::Max(hn::Abs(p[1].x), hn::Abs(p[1].y)),
                       hn::Max(hn::Abs(p[2].x), hn::Abs(p[2].y)));
    for (int i = 0; i < 3; ++i) {
        q[i] = {dot(e1, b[i]), dot(e2, b[i])};
        extent = hn::Max(extent, hn::Max(hn::Abs(q[i].x), hn::Abs(q[i].y)));
    }
    // Adding and taking away 6 * 2^e rounds to multiples of the last digit of 4 * 2^e.
    const V rounder = hn::Set(d, 6) * power_of_two(d, extent);
    for (int i = 0; i < 3; ++i) {
        p[i] = {(p[i].x + rounder) - rounder, (p[i].y + rounder) - rounder};
        q[i] = {(q[i].x + rounder) - rounder, (q[i].y + rounder) - rounder};
    }

    P edge_p[3], edge_q[3];
    V overlap_p[3], overlap_q[3];
    for (int i = 0; i < 3; ++i) {
        edge_p[i] = p[(i + 1) % 3] - p[i];
        edge_q[i] = q[(i + 1) % 3] - q[i];
        overlap_p[i] = hn::MulAdd(dx, p[i].x, hn::MulAdd(dy, p[i].y, d0));
        overlap_q[i] = hn::MulAdd(dx, q[i].x, hn::MulAdd(dy, q[i].y, d0));
    }
    // p_in_q[i][k]: side of corner i of A^p on edge k of B^p.
    V p_in_q[3][3], q_in_p[3][3];
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) {
            p_in_q[i][k] = cross(d, edge_q[k], p[i] - q[k]);
            q_in_p[i][k] = cross(d, edge_p[k], q[i] - p[k]);
        }
    M cut = hn::Lt(one, zero);
    Segment<D> side[6];
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        side[i] = clip_edge<false>(d, p[i], edge_p[i], p_in_q[i], p_in_q[j], overlap_p[i],
                                   overlap_p[j], cut);
        side[3 + i] = clip_edge<true>(d, q[i], edge_q[i], q_in_p[i], q_in_p[j], overlap_q[i],
                                      overlap_q[j], cut);
    }

    // The origin of the moments.
    P middle{zero, zero};
    V n_sides = zero, largest = hn::Set(d, -1);
    for (const Segment<D>& s : side) {
        middle.x = middle.x + hn::IfThenElseZero(s.is_there, s.from.x + s.to.x);
        middle.y = middle.y + hn::IfThenElseZero(s.is_there, s.from.y + s.to.y);
        n_sides = n_sides + hn::IfThenElseZero(s.is_there, one);
        largest = hn::IfThenElse(s.is_there,
                                 hn::Max(largest, hn::Max(s.overlap_from, s.overlap_to)), largest);
    }
    const M has_sides = hn::Gt(n_sides, zero);
    const V share = hn::Set(d, static_cast<T>(0.5)) / hn::Max(n_sides, one);
    const V overlap_middle = hn::MulAdd(dx, share * middle.x, hn::MulAdd(dy, share * middle.y, d0));
    const V gradient2 = hn::MulAdd(dx, dx, dy * dy);
    // The line delta = 0 is not far if it cuts the polygon; if rounding says so, stay.
    const V far = hn::Set(d, 4) * extent;
    const M to_line = hn::And(hn::And(cut, hn::Gt(gradient2, zero)),
                              hn::Lt(overlap_middle * overlap_middle, gradient2 * (far * far)));
    const V back = hn::IfThenElseZero(to_line, overlap_middle / gradient2);
    const P origin{hn::NegMulAdd(back, dx, share * middle.x),
                   hn::NegMulAdd(back, dy, share * middle.y)};
    const V d_origin = hn::MulAdd(dx, origin.x, hn::MulAdd(dy, origin.y, d0));

    Moments<V> m{zero, zero, zero, zero, zero, zero};
    for (const Segment<D>& s : side) add_side(d, s, origin, m);
    m.s = hn::Set(d, static_cast<T>(1.0 / 2)) * m.s;
    const V sixth = hn::Set(d, static_cast<T>(1.0 / 6)),
            twelfth = hn::Set(d, static_cast<T>(1.0 / 12));
    m.sx = sixth * m.sx;
    m.sy = sixth * m.sy;
    m.sxx = twelfth * m.sxx;
    m.syy = twelfth * m.syy;
    m.sxy = hn::Set(d, static_cast<T>(1.0 / 24)) * m.sxy;

    // Same limits as in contact_of_triangles.
    const V twice_p = cross(d, edge_p[0], p[2] - p[0]), twice_q = cross(d, edge_q[0], q[2] - q[0]);
    const V smallest =
        hn::Set(d, static_cast<T>(k_edge_on)) * hn::Max(hn::Abs(twice_p), hn::Abs(twice_q));
    const M is_seen = hn::And(hn::Gt(twice_p, smallest), hn::Gt(twice_q, smallest));
    const M touches = hn::And(hn::And(has_sides, is_seen),
                              hn::Ge(m.s, hn::Set(d, static_cast<T>(k_smallest_polygon_um2))));
    const V x = m.sx / m.s, y = m.sy / m.s;
    const V mean_overlap = hn::MulAdd(dx, x, hn::MulAdd(dy, y, d_origin));
    const M is_deep = hn::Gt(mean_overlap, hn::Set(d, task.largest_overlap));
    alignas(8) std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, hn::AndNot(is_deep, touches), bits);
    out.active = static_cast<std::uint64_t>(bits[0]) | static_cast<std::uint64_t>(bits[1]) << 8U;
    hn::StoreMaskBits(d, hn::And(is_deep, touches), bits);
    out.too_deep = static_cast<std::uint64_t>(bits[0]) | static_cast<std::uint64_t>(bits[1]) << 8U;
    if (out.active == 0) return;

    // P = p0 + px x + py y about the origin, its resultant and first moment.
    const V k = hn::Set(d, task.k), P0 = hn::Set(d, task.P0);
    const V p0 = hn::MulSub(k, d_origin, P0), px = k * dx, py = k * dy;
    const V force = hn::MulAdd(p0, m.s, hn::MulAdd(px, m.sx, py * m.sy));
    const V force_x = hn::MulAdd(p0, m.sx, hn::MulAdd(px, m.sxx, py * m.sxy));
    const V force_y = hn::MulAdd(p0, m.sy, hn::MulAdd(px, m.sxy, py * m.syy));
    const V two = hn::Set(d, 2);
    // Corner 0 is opposite to the edge 1 -> 2; corner 1 of A is p[2], opposite to 0 -> 1.
    const Barycentric<V> l0 = barycentric(d, p[1], edge_p[1], twice_p, origin);
    const Barycentric<V> l1 = barycentric(d, p[0], edge_p[0], twice_p, origin);
    const Barycentric<V> m0 = barycentric(d, q[1], edge_q[1], twice_q, origin);
    const Barycentric<V> m1 = barycentric(d, q[2], edge_q[2], twice_q, origin);
    const V slope = hn::MulAdd(dx, m.sx, dy * m.sy);
    const V overlap2 =
        hn::MulAdd(d_origin, hn::MulAdd(d_origin, m.s, two * slope),
                   hn::MulAdd(dx * dx, m.sxx, hn::MulAdd(two * dx * dy, m.sxy, dy * dy * m.syy)));
    const V energy =
        hn::MulSub(hn::Set(d, static_cast<T>(0.5)) * k, overlap2, P0 * mean_overlap * m.s);
    hn::StoreU(n.x, d, out.value[Value::normal_x]);
    hn::StoreU(n.y, d, out.value[Value::normal_y]);
    hn::StoreU(n.z, d, out.value[Value::normal_z]);
    hn::StoreU(m.s, d, out.value[Value::area]);
    hn::StoreU(force, d, out.value[Value::force]);
    hn::StoreU(l0.value(force, force_x, force_y), d, out.value[Value::force_a0]);
    hn::StoreU(l1.value(force, force_x, force_y), d, out.value[Value::force_a1]);
    hn::StoreU(m0.value(force, force_x, force_y), d, out.value[Value::force_b0]);
    hn::StoreU(m1.value(force, force_x, force_y), d, out.value[Value::force_b1]);
    hn::StoreU(l0.value(one, x, y), d, out.value[Value::lambda0]);
    hn::StoreU(l1.value(one, x, y), d, out.value[Value::lambda1]);
    hn::StoreU(m0.value(one, x, y), d, out.value[Value::mu0]);
    hn::StoreU(m1.value(one, x, y), d, out.value[Value::mu1]);
    hn::StoreU(energy, d, out.value[Value::energy]);
    hn::StoreU(mean_overlap, d, out.value[Value::overlap]);
    hn::StoreU(hn::Max(largest, mean_overlap), d, out.value[Value::largest_overlap]);
}

}  // namespace HWY_NAMESPACE
}  // namespace spheroscope::lanes
HWY_AFTER_NAMESPACE();

#endif
