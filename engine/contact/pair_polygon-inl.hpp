// The polygon in which two projected triangles overlap, per lane. Included once for each SIMD
// target.
//
// Sutherland and Hodgman's polygon has a different number of corners in every lane. Here the
// boundary of the polygon is taken as a set of segments in no order: what B^p leaves of the three
// edges of A^p and what A^p leaves of those of B^p (Cyrus and Beck 1978), each cut by delta >= 0.
// Green's theorem sums them to the moments. Three things make that safe:
//
//  - The projected corners lie on a grid of 2^-22 of their extent (on_grid). Differences of corners
//    are then exact, and a cross product of two differences, from two fused products (Kahan), has
//    the right sign and 24 right digits. So both triangles agree on which corner lies on which
//    side, however small the angle between two edges is, and an edge that both have is counted
//    once: it is inside for A^p (>= 0) and outside for B^p (> 0).
//  - The line delta = 0 is the polygon's last side. It is never made: moments are taken about a
//    point on this line, where its part of the integrals is zero.
//  - Otherwise they are taken about the middle of the segments' ends, so that small polygons keep
//    their digits.

#if defined(SPHEROSCOPE_PAIR_POLYGON_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SPHEROSCOPE_PAIR_POLYGON_INL
#undef SPHEROSCOPE_PAIR_POLYGON_INL
#else
#define SPHEROSCOPE_PAIR_POLYGON_INL
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace spheroscope::lanes {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class V> struct Point2 { V x, y; };

template <class V> HWY_INLINE Point2<V> operator-(const Point2<V>& p, const Point2<V>& q) {
    return {p.x - q.x, p.y - q.y};
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

/// delta as a function of the position in the contact plane, relative to some origin.
template <class V> struct Overlap {
    V at_origin, dx, dy;
    HWY_INLINE V at(const Point2<V>& p) const {
        return hn::MulAdd(dx, p.x, hn::MulAdd(dy, p.y, at_origin));
    }
    HWY_INLINE Overlap about(const Point2<V>& origin) const { return {at(origin), dx, dy}; }
};

/// A triangle in the contact plane, counter-clockwise: edge[i] leads from corner[i] to the next.
template <class V> struct FlatTriangle {
    Point2<V> corner[3], edge[3];
    V overlap[3];  ///< delta at the corners
};

/// Moves corners to the grid, after which their differences are exact. `extent` bounds both
/// coordinates.
template <class D, class V = hn::Vec<D>> HWY_INLINE FlatTriangle<V>
on_grid(D d, const Point2<V>* corner, V extent, const Overlap<V>& overlap) {
    // Adding and taking away 6 * 2^e rounds to multiples of the last digit of 4 * 2^e.
    const V rounder = hn::Set(d, 6) * power_of_two(d, extent);
    FlatTriangle<V> t;
    for (int i = 0; i < 3; ++i)
        t.corner[i] = {(corner[i].x + rounder) - rounder, (corner[i].y + rounder) - rounder};
    for (int i = 0; i < 3; ++i) {
        t.edge[i] = t.corner[(i + 1) % 3] - t.corner[i];
        t.overlap[i] = overlap.at(t.corner[i]);
    }
    return t;
}

template <class D, class V = hn::Vec<D>> HWY_INLINE V twice_area(D d, const FlatTriangle<V>& t) {
    return cross(d, t.edge[0], t.corner[2] - t.corner[0]);
}

/// On which side of the edges of `of` a point lies: > 0 inside.
template <class D, class V = hn::Vec<D>>
HWY_INLINE void sides_of_edges(D d, const FlatTriangle<V>& of, const Point2<V>& point, V* side) {
    for (int k = 0; k < 3; ++k) side[k] = cross(d, of.edge[k], point - of.corner[k]);
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

/// The boundary of the polygon but for its side on the line delta = 0.
template <class D> struct Polygon {
    Segment<D> side[6];
    hn::Mask<D> is_cut;  ///< by delta = 0
};

/// Each triangle's edges clipped by the other's half-planes. The other is closed for the edges of
/// `p` and open for those of `q`, so that an edge that both have is taken from `p` alone.
template <class D, class V = hn::Vec<D>>
HWY_INLINE Polygon<D> common_polygon(D d, const FlatTriangle<V>& p, const FlatTriangle<V>& q) {
    V p_in_q[3][3], q_in_p[3][3];  // [corner][edge of the other]
    for (int i = 0; i < 3; ++i) {
        sides_of_edges(d, q, p.corner[i], p_in_q[i]);
        sides_of_edges(d, p, q.corner[i], q_in_p[i]);
    }
    Polygon<D> polygon;
    polygon.is_cut = hn::Lt(hn::Set(d, 1), hn::Zero(d));
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        polygon.side[i] = clip_edge<false>(d, p.corner[i], p.edge[i], p_in_q[i], p_in_q[j],
                                           p.overlap[i], p.overlap[j], polygon.is_cut);
        polygon.side[3 + i] = clip_edge<true>(d, q.corner[i], q.edge[i], q_in_p[i], q_in_p[j],
                                              q.overlap[i], q.overlap[j], polygon.is_cut);
    }
    return polygon;
}

/// The ends of all segments; every corner of a closed polygon is two of them.
template <class V> struct SegmentEnds {
    Point2<V> sum;
    V n_segments, largest_overlap;  ///< -1 without segments
};

template <class D, class V = hn::Vec<D>>
HWY_INLINE SegmentEnds<V> segment_ends(D d, const Polygon<D>& polygon) {
    const V one = hn::Set(d, 1);
    SegmentEnds<V> ends{{hn::Zero(d), hn::Zero(d)}, hn::Zero(d), hn::Set(d, -1)};
    for (const Segment<D>& s : polygon.side) {
        ends.sum.x = ends.sum.x + hn::IfThenElseZero(s.is_there, s.from.x + s.to.x);
        ends.sum.y = ends.sum.y + hn::IfThenElseZero(s.is_there, s.from.y + s.to.y);
        ends.n_segments = ends.n_segments + hn::IfThenElseZero(s.is_there, one);
        ends.largest_overlap = hn::IfThenElse(
            s.is_there, hn::Max(ends.largest_overlap, hn::Max(s.overlap_from, s.overlap_to)),
            ends.largest_overlap);
    }
    return ends;
}

/// Where moments are taken about: the middle of the segments' ends, and from there straight to the
/// line delta = 0 where that is a side, because a side adds nothing to moments about its own
/// points.
template <class D, class V = hn::Vec<D>>
HWY_INLINE Point2<V> moment_origin(D d, const SegmentEnds<V>& ends, hn::Mask<D> is_cut, V extent,
                                   const Overlap<V>& overlap) {
    using T = hn::TFromD<D>;
    const V share = hn::Set(d, static_cast<T>(0.5)) / hn::Max(ends.n_segments, hn::Set(d, 1));
    const Point2<V> middle{share * ends.sum.x, share * ends.sum.y};
    const V overlap_middle = overlap.at(middle);
    const V gradient2 = hn::MulAdd(overlap.dx, overlap.dx, overlap.dy * overlap.dy);
    // The line delta = 0 is not far if it cuts the polygon; if rounding says so, stay.
    const V far = hn::Set(d, 4) * extent;
    const auto to_line = hn::And(hn::And(is_cut, hn::Gt(gradient2, hn::Zero(d))),
                                 hn::Lt(overlap_middle * overlap_middle, gradient2 * (far * far)));
    const V back = hn::IfThenElseZero(to_line, overlap_middle / gradient2);
    return {hn::NegMulAdd(back, overlap.dx, middle.x), hn::NegMulAdd(back, overlap.dy, middle.y)};
}

/// Integrals of 1, x, y, xx, xy, yy.
template <class V> struct Moments { V s, sx, sy, sxx, sxy, syy; };

/// Adds what one side of the polygon is in the sums of Green's theorem, relative to `origin`.
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

/// Moments of the polygon about `origin`: an integral over an area is one along its boundary
/// (Green's theorem), in which segments stand in any order.
template <class D, class V = hn::Vec<D>>
HWY_INLINE Moments<V> moments_about(D d, const Polygon<D>& polygon, const Point2<V>& origin) {
    using T = hn::TFromD<D>;
    const V zero = hn::Zero(d);
    Moments<V> m{zero, zero, zero, zero, zero, zero};
    for (const Segment<D>& s : polygon.side) add_side(d, s, origin, m);
    const V sixth = hn::Set(d, static_cast<T>(1.0 / 6)),
            twelfth = hn::Set(d, static_cast<T>(1.0 / 12));
    m.s = hn::Set(d, static_cast<T>(1.0 / 2)) * m.s;
    m.sx = sixth * m.sx;
    m.sy = sixth * m.sy;
    m.sxx = twelfth * m.sxx;
    m.syy = twelfth * m.syy;
    m.sxy = hn::Set(d, static_cast<T>(1.0 / 24)) * m.sxy;
    return m;
}

}  // namespace HWY_NAMESPACE
}  // namespace spheroscope::lanes
HWY_AFTER_NAMESPACE();

#endif
