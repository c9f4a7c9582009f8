// The records of many triangles, one in each lane, as one vector for each number of a record.
// Included once for each SIMD target.
//
// Records are read whole, 128 bits at a time, and turned round in registers. Instructions that
// gather single numbers take an access to memory for each, sixteen for what is one here.

#if defined(SPHEROSCOPE_PAIR_RECORDS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SPHEROSCOPE_PAIR_RECORDS_INL
#undef SPHEROSCOPE_PAIR_RECORDS_INL
#else
#define SPHEROSCOPE_PAIR_RECORDS_INL
#endif

#include "engine/contact/pair_lanes.hpp"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace spheroscope::lanes {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR

template <class D, class T = hn::TFromD<D>>
HWY_INLINE void load_records(D d, const T* record, const IndexOf<T>* triangle, hn::Vec<D>* number) {
    const T* const from = record + static_cast<std::size_t>(*triangle) * k_record;
    for (std::size_t i = 0; i < k_used_of_record; ++i) number[i] = hn::Load(d, from + i);
}

#else

/// How many numbers are in 128 bits.
template <class T> constexpr std::size_t k_in_block = 16 / sizeof(T);

/// A vector of blocks of 128 bits: the numbers from `from` on of the records of triangle[0],
/// triangle[k_in_block], triangle[2 k_in_block] ...
template <class D, class T = hn::TFromD<D>>
HWY_INLINE hn::Vec<D> load_blocks(D d, const T* from, const IndexOf<T>* triangle) {
    if constexpr (sizeof(hn::Vec<D>) <= 16) {
        return hn::LoadU(d, from + static_cast<std::size_t>(*triangle) * k_record);
    } else {
        const hn::Half<D> half;
        const auto low = load_blocks(half, from, triangle);
        return hn::Combine(d, load_blocks(half, from, triangle + hn::Lanes(half)), low);
    }
}

/// Row i of each block becomes column i: four rows of four floats, or two of two doubles.
template <class D> HWY_INLINE void transpose_blocks(D d, hn::Vec<D>* row) {
    if constexpr (sizeof(hn::TFromD<D>) == 8) {
        const auto first = hn::InterleaveLower(d, row[0], row[1]);
        row[1] = hn::InterleaveUpper(d, row[0], row[1]);
        row[0] = first;
    } else {
        const hn::Repartition<double, D> pairs;
        const auto low01 = hn::BitCast(pairs, hn::InterleaveLower(d, row[0], row[1]));
        const auto low23 = hn::BitCast(pairs, hn::InterleaveLower(d, row[2], row[3]));
        const auto high01 = hn::BitCast(pairs, hn::InterleaveUpper(d, row[0], row[1]));
        const auto high23 = hn::BitCast(pairs, hn::InterleaveUpper(d, row[2], row[3]));
        row[0] = hn::BitCast(d, hn::InterleaveLower(pairs, low01, low23));
        row[1] = hn::BitCast(d, hn::InterleaveUpper(pairs, low01, low23));
        row[2] = hn::BitCast(d, hn::InterleaveLower(pairs, high01, high23));
        row[3] = hn::BitCast(d, hn::InterleaveUpper(pairs, high01, high23));
    }
}

/// number [k_used_of_record]: in lane l, those of triangle[l]. record [triangles x k_record].
template <class D, class T = hn::TFromD<D>>
HWY_INLINE void load_records(D d, const T* record, const IndexOf<T>* triangle, hn::Vec<D>* number) {
    static_assert(k_used_of_record % k_in_block<T> == 0);
    for (std::size_t first = 0; first < k_used_of_record; first += k_in_block<T>) {
        for (std::size_t row = 0; row < k_in_block<T>; ++row)
            number[first + row] = load_blocks(d, record + first, triangle + row);
        transpose_blocks(d, number + first);
    }
}

#endif

template <class V> struct Point3 { V x, y, z; };

template <class V> HWY_INLINE V dot(const Point3<V>& p, const Point3<V>& q) {
    return hn::MulAdd(p.x, q.x, hn::MulAdd(p.y, q.y, p.z * q.z));
}

template <class V> HWY_INLINE Point3<V> cross(const Point3<V>& p, const Point3<V>& q) {
    return {hn::MulSub(p.y, q.z, p.z * q.y), hn::MulSub(p.z, q.x, p.x * q.z),
            hn::MulSub(p.x, q.y, p.y * q.x)};
}

/// Corners and outward normals, relative to corner 0 of A: nothing cancels far from an origin.
template <class V> struct TrianglePair { Point3<V> a[3], b[3], normal_a, normal_b; };

template <class D, class V = hn::Vec<D>>
HWY_INLINE TrianglePair<V> loaded_pair(D d, const Task<hn::TFromD<D>>& task,
                                       const IndexOf<hn::TFromD<D>>* triangle_a,
                                       const IndexOf<hn::TFromD<D>>* triangle_b) {
    const V zero = hn::Zero(d);
    V a[k_used_of_record], b[k_used_of_record];
    load_records(d, task.a.record, triangle_a, a);
    load_records(d, task.b.record, triangle_b, b);
    const Point3<V> shift{hn::Set(d, task.offset[0]) - a[0], hn::Set(d, task.offset[1]) - a[1],
                          hn::Set(d, task.offset[2]) - a[2]};
    TrianglePair<V> pair;
    pair.normal_a = {a[9], a[10], a[11]};
    pair.normal_b = {b[9], b[10], b[11]};
    pair.a[0] = {zero, zero, zero};
    for (std::size_t i = 1; i < 3; ++i)
        pair.a[i] = {a[3 * i] - a[0], a[3 * i + 1] - a[1], a[3 * i + 2] - a[2]};
    for (std::size_t i = 0; i < 3; ++i)
        pair.b[i] = {b[3 * i] + shift.x, b[3 * i + 1] + shift.y, b[3 * i + 2] + shift.z};
    return pair;
}

}  // namespace HWY_NAMESPACE
}  // namespace spheroscope::lanes
HWY_AFTER_NAMESPACE();

#endif
