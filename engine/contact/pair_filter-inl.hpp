// Which pairs of triangles can be contacts at all. Included once for each SIMD target.
//
// Every test leaves out only what cannot touch, by more than rounding (`k_slack`), so the clip
// alone decides. The order is that of the triangles' indices from beginning to end. Children of a
// subdivided triangle have consecutive indices, so 16 of them in a row are a patch of the surface:
// one sphere around each patch of B rules most of them out at once. Spheres and circles around
// triangles (may_touch) leave three pairs for each contact; their corners are looked at in full
// vectors again (are_apart), which leaves hardly more than the contacts.

#if defined(SPHEROSCOPE_PAIR_FILTER_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SPHEROSCOPE_PAIR_FILTER_INL
#undef SPHEROSCOPE_PAIR_FILTER_INL
#else
#define SPHEROSCOPE_PAIR_FILTER_INL
#endif

#include "engine/contact/pair_lanes.hpp"
#include "engine/contact/pair_records-inl.hpp"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace spheroscope::lanes {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Of the size of triangles, against the rounding of positions (3e-7 um in floats).
constexpr double k_slack = 1e-4;

/// Writes the lanes of v whose mask is set side by side and returns how many. Always writes a whole
/// vector: no branch on numbers that cannot be foreseen.
template <class D, class M>
HWY_INLINE std::size_t append(D d, hn::Vec<D> v, M mask, hn::TFromD<D>* out) {
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_SSE4
    // GCC 12 copies Highway's table of a kilobyte to the stack in every Compress of these targets.
    alignas(8) std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, mask, bits);
    const hn::RebindToSigned<D> di;
    const auto order = hn::LoadU(di, k_set_bits<hn::TFromD<decltype(di)>>.position[bits[0]]);
    hn::StoreU(hn::TableLookupLanes(v, hn::IndicesFromVec(d, order)), d, out);
    return hwy::PopCount(bits[0]);
#else
    hn::StoreU(hn::Compress(v, mask), d, out);
    return hn::CountTrue(d, mask);
#endif
}

/// Triangles that are near the other cell's box, in `near`, and their extents along `direction`
/// times `sign`; returns how many. `farthest` rises to the largest extent.
template <class D, class T = hn::TFromD<D>>
HWY_INLINE std::size_t near_box(D d, const Side<T>& side, std::size_t n_triangles, T margin,
                                const T* direction, T sign, IndexOf<T>* near, T* extent,
                                T& farthest) {
    using V = hn::Vec<D>;
    const hn::RebindToSigned<D> di;
    const V zero = hn::Zero(d), one = hn::Set(d, 1), grow = hn::Set(d, margin);
    V most = hn::Set(d, farthest);
    std::size_t n_near = 0;
    const std::size_t n_lanes = hn::Lanes(d);
    for (std::size_t t = 0; t < n_triangles; t += n_lanes) {
        const V reach = hn::LoadU(d, side.reach + t);
        const V grown = reach + grow;
        auto is_near = hn::FirstN(d, n_triangles - t);
        for (std::size_t k = 0; k < 3; ++k) {
            const V centre = hn::LoadU(d, side.centroid[k] + t);
            const V below = hn::Set(d, side.other_low[k]) - centre;
            const V above = centre - hn::Set(d, side.other_high[k]);
            is_near = hn::And(is_near, hn::Le(hn::Max(below, above), grown));
        }
        if (hn::AllFalse(d, is_near)) continue;
        V along = zero, upright = zero;
        for (std::size_t k = 0; k < 3; ++k) {
            const V axis = hn::Set(d, sign * direction[k]);
            along = hn::MulAdd(axis, hn::LoadU(d, side.centroid[k] + t), along);
            upright = hn::MulAdd(axis, hn::LoadU(d, side.normal[k] + t), upright);
        }
        // A triangle across the direction has no extent along it.
        const V flat = hn::Sqrt(hn::Max(zero, one - upright * upright));
        const V top = hn::MulAdd(reach, flat, along);
        most = hn::IfThenElse(is_near, hn::Max(most, top), most);
        static_cast<void>(append(d, top, is_near, extent + n_near));
        n_near += append(di, hn::Iota(di, static_cast<IndexOf<T>>(t)), hn::RebindMask(di, is_near),
                         near + n_near);
    }
    farthest = hn::GetLane(hn::MaxOfLanes(d, most));
    return n_near;
}

/// Keeps the triangles of `near` whose extent is at least `least`.
template <class T> HWY_INLINE std::size_t keep_reaching(const T* extent, T least, IndexOf<T>* near,
                                                        std::size_t n_near) {
    std::size_t n_kept = 0;
    for (std::size_t i = 0; i < n_near; ++i) {
        near[n_kept] = near[i];
        n_kept += extent[i] >= least ? 1U : 0U;
    }
    return n_kept;
}

/// Copies triangle t of B to place i of the packed ones, relative to the origin of A.
template <class T> HWY_INLINE void pack_one(const Task<T>& task, const Buffers<T>& buffers,
                                            std::size_t i, std::size_t t) {
    for (std::size_t k = 0; k < 3; ++k) {
        buffers.centroid_b[k][i] = task.b.centroid[k][t] + task.offset[k];
        buffers.normal_b[k][i] = task.b.normal[k][t];
    }
    buffers.reach_b[i] = task.b.reach[t];
}

/// Puts a sphere around the triangles of one block.
template <class D, class T = hn::TFromD<D>>
HWY_INLINE void enclose_block(D d, const Buffers<T>& buffers, std::size_t block) {
    using V = hn::Vec<D>;
    const std::size_t begin = block * k_block, end = begin + k_block, n_lanes = hn::Lanes(d);
    T centre[3];
    for (std::size_t k = 0; k < 3; ++k) {
        const T* const at = buffers.centroid_b[k];
        V low = hn::LoadU(d, at + begin), high = low;
        for (std::size_t i = begin + n_lanes; i < end; i += n_lanes) {
            const V centroid = hn::LoadU(d, at + i);
            low = hn::Min(low, centroid);
            high = hn::Max(high, centroid);
        }
        centre[k] =
            (hn::GetLane(hn::MinOfLanes(d, low)) + hn::GetLane(hn::MaxOfLanes(d, high))) / 2;
        buffers.block_centre[k][block] = centre[k];
    }
    V most2 = hn::Zero(d), reach = most2;
    for (std::size_t i = begin; i < end; i += n_lanes) {
        V r2 = hn::Zero(d);
        for (std::size_t k = 0; k < 3; ++k) {
            const V r = hn::LoadU(d, buffers.centroid_b[k] + i) - hn::Set(d, centre[k]);
            r2 = hn::MulAdd(r, r, r2);
        }
        most2 = hn::Max(most2, r2);
        reach = hn::Max(reach, hn::LoadU(d, buffers.reach_b + i));
    }
    buffers.block_reach[block] =
        hn::GetLane(hn::Sqrt(hn::MaxOfLanes(d, most2))) + hn::GetLane(hn::MaxOfLanes(d, reach));
}

/// Copies the near triangles of B side by side, relative to the origin of A, and puts spheres
/// around blocks of them. Returns the number of blocks; the last one is filled up with triangles
/// that are far from everything. Precondition: n_near > 0.
template <class D, class T = hn::TFromD<D>> HWY_INLINE std::size_t
pack_near_b(D d, const Task<T>& task, const Buffers<T>& buffers, std::size_t n_near) {
    const std::size_t n_blocks = (n_near + k_block - 1) / k_block;
    for (std::size_t i = 0; i < n_near; ++i)
        pack_one(task, buffers, i, static_cast<std::size_t>(buffers.near_b[i]));
    // The last one repeats until spheres are made: they are around whole blocks.
    for (std::size_t i = n_near; i < n_blocks * k_block; ++i)
        pack_one(task, buffers, i, static_cast<std::size_t>(buffers.near_b[n_near - 1]));
    for (std::size_t block = 0; block < n_blocks; ++block) enclose_block(d, buffers, block);
    for (std::size_t i = n_near; i < n_blocks * k_block; ++i)
        for (std::size_t k = 0; k < 3; ++k) buffers.centroid_b[k][i] = static_cast<T>(1e9);
    return n_blocks;
}

/// One triangle of A, the same in all lanes.
template <class D> struct Row {
    hn::Vec<D> centroid[3], normal[3], reach, range, two_h0, reject_cos;
};

/// Which triangles of B from position `first` on may touch the triangle of A.
template <class D, class T = hn::TFromD<D>>
HWY_INLINE hn::Mask<D> may_touch(D d, const Row<D>& a, const Buffers<T>& b, std::size_t first) {
    using V = hn::Vec<D>;
    const V zero = hn::Zero(d);
    const V reach_b = hn::LoadU(d, b.reach_b + first);
    V cosine = zero, along_a = zero, along_b = zero, distance2 = zero;
    for (std::size_t k = 0; k < 3; ++k) {
        const V between = a.centroid[k] - hn::LoadU(d, b.centroid_b[k] + first);
        const V normal_b = hn::LoadU(d, b.normal_b[k] + first);
        cosine = hn::MulAdd(a.normal[k], normal_b, cosine);
        along_a = hn::MulAdd(a.normal[k], between, along_a);
        along_b = hn::MulAdd(normal_b, between, along_b);
        distance2 = hn::MulAdd(between, between, distance2);
    }
    auto may = hn::Lt(cosine, a.reject_cos);
    const V reaches = (a.reach + reach_b) * hn::Set(d, static_cast<T>(1.0 + k_slack));
    const V range = a.range + reach_b;
    may = hn::And(may, hn::Lt(distance2, range * range));
    // delta c at the centroid of A is 2 h0 + n_B.(c_B - c_A), and over A^p it rises by no more than
    // |n_A + n_B| times its reach; likewise for B. Squared: neither roots nor quotients.
    const V two = hn::Set(d, 2);
    const V rise2 = hn::Max(zero, hn::MulAdd(two, cosine, two));  // |n_A + n_B|^2
    const V within = hn::MulAdd(hn::Set(d, static_cast<T>(k_slack)), reaches, a.two_h0);
    const V gap_a = along_b - within, gap_b = hn::Neg(along_a) - within;
    may = hn::And(may, hn::Le(gap_a * hn::Abs(gap_a), rise2 * (a.reach * a.reach)));
    may = hn::And(may, hn::Le(gap_b * hn::Abs(gap_b), rise2 * (reach_b * reach_b)));
    // Circles around both, seen along n = (n_B - n_A) / |n_B - n_A|; |n_B - n_A|^2 = 2 - 2 cos.
    const V along_n = along_b - along_a;
    const V width2 = hn::NegMulAdd(two, cosine, two);
    const V beyond2 = hn::NegMulAdd(reaches, reaches, distance2);
    may = hn::And(may, hn::Lt(beyond2 * width2, along_n * along_n));
    return may;
}

/// Appends the pairs of one triangle of A with those of near_b that it may touch to the survivors,
/// from position n on; returns how many.
template <class D, class T = hn::TFromD<D>>
HWY_INLINE std::size_t filter_row(D d, const Task<T>& task, const Buffers<T>& buffers,
                                  std::size_t n_blocks, IndexOf<T> triangle, std::size_t n) {
    const hn::RebindToSigned<D> di;
    const auto t = static_cast<std::size_t>(triangle);
    Row<D> row;
    const T reach = task.a.reach[t];
    for (std::size_t k = 0; k < 3; ++k) {
        row.centroid[k] = hn::Set(d, task.a.centroid[k][t]);
        row.normal[k] = hn::Set(d, task.a.normal[k][t]);
    }
    row.reach = hn::Set(d, reach);
    row.range = hn::Set(d, (reach + task.reach) * static_cast<T>(1.0 + k_slack));
    row.two_h0 = hn::Set(d, task.h0 + task.h0);
    row.reject_cos = hn::Set(d, task.reject_cos);

    const std::size_t n_lanes = hn::Lanes(d);
    std::size_t n_open = 0;
    for (std::size_t block = 0; block < n_blocks; block += n_lanes) {
        auto distance2 = hn::Zero(d);
        for (std::size_t k = 0; k < 3; ++k) {
            const auto between = hn::LoadU(d, buffers.block_centre[k] + block) - row.centroid[k];
            distance2 = hn::MulAdd(between, between, distance2);
        }
        const auto most = row.range + hn::LoadU(d, buffers.block_reach + block);
        const auto is_open =
            hn::And(hn::Lt(distance2, most * most), hn::FirstN(d, n_blocks - block));
        n_open += append(di, hn::Iota(di, static_cast<IndexOf<T>>(block)),
                         hn::RebindMask(di, is_open), buffers.open_block + n_open);
    }
    const auto same = hn::Set(di, triangle);
    const std::size_t start = n;
    for (std::size_t i = 0; i < n_open; ++i) {
        const std::size_t begin = static_cast<std::size_t>(buffers.open_block[i]) * k_block;
        for (std::size_t first = begin; first < begin + k_block; first += n_lanes) {
            hn::StoreU(same, di, buffers.survivor_a + n);
            n += append(di, hn::LoadU(di, buffers.near_b + first),
                        hn::RebindMask(di, may_touch(d, row, buffers, first)),
                        buffers.survivor_b + n);
        }
    }
    return n - start;
}

/// The smallest of v.p over the three corners p.
template <class V> HWY_INLINE V lowest_along(const Point3<V>& v, const Point3<V>* corner) {
    return hn::Min(hn::Min(dot(v, corner[0]), dot(v, corner[1])), dot(v, corner[2]));
}

/// Whether an edge of `of`, seen against `axis`, has all corners of the other triangle outside, by
/// more than `slack`. The corners of `of` go counter-clockwise when they are seen like this.
template <class D, class V = hn::Vec<D>> HWY_INLINE hn::Mask<D>
separates(D d, const Point3<V>* of, const Point3<V>* other, const Point3<V>& axis, V slack) {
    V widest = hn::Set(d, -1);
    for (int i = 0; i < 3; ++i) {
        const Point3<V>&from = of[i], &to = of[(i + 1) % 3];
        const Point3<V> outward =
            cross(Point3<V>{to.x - from.x, to.y - from.y, to.z - from.z}, axis);
        widest = hn::Max(widest, lowest_along(outward, other) - dot(outward, from));
    }
    return hn::Gt(widest, slack);
}

/// Pairs whose projections along n an edge separates, or with a triangle that has delta < 0 at all
/// of its corners.
template <class D, class V = hn::Vec<D>>
HWY_INLINE hn::Mask<D> are_apart(D d, const TrianglePair<V>& pair, hn::TFromD<D> h0) {
    using T = hn::TFromD<D>;
    const Point3<V>&n_a = pair.normal_a, &n_b = pair.normal_b;
    // A's corners go round its own normal, which is against n; no unit vector is needed.
    const Point3<V> along_n{n_b.x - n_a.x, n_b.y - n_a.y, n_b.z - n_a.z};
    const Point3<V> against_n{n_a.x - n_b.x, n_a.y - n_b.y, n_a.z - n_b.z};
    V size2 = hn::Zero(d);
    for (int i = 0; i < 3; ++i)
        size2 = size2 + dot(pair.a[i], pair.a[i]) + dot(pair.b[i], pair.b[i]);
    const V slack = hn::Set(d, static_cast<T>(k_slack)), slack_area = slack * size2;
    const auto separate = hn::Or(separates(d, pair.a, pair.b, against_n, slack_area),
                                 separates(d, pair.b, pair.a, along_n, slack_area));
    // delta c is 2 h0 plus a corner's height over the other triangle's plane.
    const V at_a = dot(n_b, pair.b[0]) - lowest_along(n_b, pair.a);
    const V at_b = hn::Neg(lowest_along(n_a, pair.b));
    const V highest = hn::Min(at_a, at_b) + hn::Set(d, h0 + h0);
    return hn::Or(separate, hn::Lt(highest * hn::Abs(highest), hn::Neg(slack * slack_area)));
}

/// Keeps those of the first n survivors that are not apart, in their order; returns how many. The
/// last one has to be repeated to the end of its vector.
template <class D, class T = hn::TFromD<D>> HWY_INLINE std::size_t
keep_overlapping(D d, const Task<T>& task, const Buffers<T>& buffers, std::size_t n) {
    const hn::RebindToSigned<D> di;
    std::size_t n_kept = 0;
    for (std::size_t first = 0; first < n; first += hn::Lanes(d)) {
        const IndexOf<T>*const a = buffers.survivor_a + first, *const b =
                                                                   buffers.survivor_b + first;
        const auto apart = hn::RebindMask(di, are_apart(d, loaded_pair(d, task, a, b), task.h0));
        const auto kept = hn::AndNot(apart, hn::FirstN(di, n - first));
        // Never writes beyond this vector, and only after it has been read.
        const auto triangle_a = hn::LoadU(di, a), triangle_b = hn::LoadU(di, b);
        static_cast<void>(append(di, triangle_a, kept, buffers.survivor_a + n_kept));
        n_kept += append(di, triangle_b, kept, buffers.survivor_b + n_kept);
    }
    return n_kept;
}

}  // namespace HWY_NAMESPACE
}  // namespace spheroscope::lanes
HWY_AFTER_NAMESPACE();

#endif
