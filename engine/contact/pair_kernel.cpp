#include "engine/contact/pair_kernel.hpp"

#include "engine/contact/pair_lanes.hpp"

#include <bit>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/contact/pair_kernel.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, which includes this file once more for each target.
#include "engine/contact/pair_clip-inl.hpp"
#include "engine/contact/pair_filter-inl.hpp"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace spheroscope::lanes {
namespace HWY_NAMESPACE {

/// Repeats the last survivor to the end of its vector.
template <class D, class T = hn::TFromD<D>>
HWY_INLINE void fill_last_vector(D d, const Buffers<T>& buffers, std::size_t n) {
    for (std::size_t i = n; i < n + hn::Lanes(d); ++i) {
        buffers.survivor_a[i] = buffers.survivor_a[n - 1];
        buffers.survivor_b[i] = buffers.survivor_b[n - 1];
    }
}

/// Clips the first n survivors, as far as they are not apart, and empties the list. Returns how
/// many it has clipped. Precondition: n > 0.
template <class D, class T = hn::TFromD<D>>
HWY_INLINE std::size_t clip_survivors(D d, const Task<T>& task, const Buffers<T>& buffers,
                                      std::size_t n, const Sink<T>& sink) {
    const std::size_t n_lanes = hn::Lanes(d);
    fill_last_vector(d, buffers, n);
    n = keep_overlapping(d, task, buffers, n);
    if (n == 0) return 0;
    fill_last_vector(d, buffers, n);
    Batch<T> batch;
    for (std::size_t first = 0; first < n; first += n_lanes) {
        batch.n = n - first < n_lanes ? n - first : n_lanes;
        batch.triangle_a = buffers.survivor_a + first;
        batch.triangle_b = buffers.survivor_b + first;
        clip_pairs(d, task, batch);
        const std::uint64_t in_use = (std::uint64_t{1} << batch.n) - 1;
        batch.active &= in_use;
        batch.too_deep &= in_use;
        if ((batch.active | batch.too_deep) != 0) sink.take(sink.self, batch);
    }
    return n;
}

/// Number of pairs that reached the clip.
template <class T> HWY_INLINE std::size_t find_pairs(const Task<T>& task, const Buffers<T>& buffers,
                                                     const Sink<T>& sink) {
    const hn::CappedTag<T, k_max_lanes> d;
    // Along the direction from B to A: the lowest of A against the highest of B.
    T lowest_a = static_cast<T>(-1e9), highest_b = static_cast<T>(-1e9);
    std::size_t n_a = near_box(d, task.a, task.n_triangles, task.reach, task.direction,
                               static_cast<T>(-1), buffers.near_a, buffers.extent_a, lowest_a);
    std::size_t n_b = near_box(d, task.b, task.n_triangles, task.reach, task.direction,
                               static_cast<T>(1), buffers.near_b, buffers.extent_b, highest_b);
    if (n_a == 0 || n_b == 0) return 0;
    T between = 0;  // of the origins
    for (std::size_t k = 0; k < 3; ++k) between += task.offset[k] * task.direction[k];
    const T margin = task.reach * static_cast<T>(1.0 + k_slack);
    n_a = keep_reaching(buffers.extent_a, -(highest_b + between) - margin, buffers.near_a, n_a);
    n_b = keep_reaching(buffers.extent_b, -lowest_a - between - margin, buffers.near_b, n_b);
    const std::size_t n_blocks = pack_near_b(d, task, buffers, n_b);
    const std::size_t room = buffers.survivors - hn::Lanes(d) - n_blocks * k_block;

    std::size_t n_candidates = 0, n = 0;
    for (std::size_t i = 0; i < n_a; ++i) {
        n += filter_row(d, task, buffers, n_blocks, buffers.near_a[i], n);
        if (n > room || (i + 1 == n_a && n > 0)) {
            n_candidates += clip_survivors(d, task, buffers, n, sink);
            n = 0;
        }
    }
    return n_candidates;
}

std::size_t find_pairs_float(const Task<float>& task, const Buffers<float>& buffers,
                             const Sink<float>& sink) {
    return find_pairs(task, buffers, sink);
}
std::size_t find_pairs_double(const Task<double>& task, const Buffers<double>& buffers,
                              const Sink<double>& sink) {
    return find_pairs(task, buffers, sink);
}

}  // namespace HWY_NAMESPACE
}  // namespace spheroscope::lanes
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace spheroscope {
namespace lanes {
HWY_EXPORT(find_pairs_float);
HWY_EXPORT(find_pairs_double);
}  // namespace lanes

namespace {

using lanes::Batch;
using lanes::IndexOf;
using lanes::Value;

/// Pairs between two flushes of the list of survivors: small enough for the first-level cache.
constexpr std::size_t k_survivors = 512;

struct Collected {
    std::vector<ContactPair>* pairs;
    std::int64_t too_deep = 0;
};

/// Turns lanes into pairs. The last of three nodal forces is what the others leave of the
/// resultant, so in double both sides carry the same force, whatever the lanes' precision.
template <class T> void collect(void* self, const Batch<T>& batch) {
    auto& collected = *static_cast<Collected*>(self);
    collected.too_deep += std::popcount(batch.too_deep);
    std::vector<ContactPair>& pairs = *collected.pairs;
    for (std::uint64_t bits = batch.active; bits != 0; bits &= bits - 1) {
        const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
        const auto value = [&](Value v) { return static_cast<double>(batch.value[v][lane]); };
        ContactPair pair;
        pair.triangle_a = static_cast<int>(batch.triangle_a[lane]);
        pair.triangle_b = static_cast<int>(batch.triangle_b[lane]);
        pair.overlap_um = static_cast<float>(batch.value[Value::overlap][lane]);
        pair.largest_overlap_um = static_cast<float>(batch.value[Value::largest_overlap][lane]);
        pair.normal = {value(Value::normal_x), value(Value::normal_y), value(Value::normal_z)};
        pair.area_um2 = value(Value::area);
        pair.energy_fJ = value(Value::energy);
        const auto three = [](double first, double second, double sum) {
            return std::array<double, 3>{first, second, sum - (first + second)};
        };
        pair.lambda = three(value(Value::lambda0), value(Value::lambda1), 1.0);
        pair.mu = three(value(Value::mu0), value(Value::mu1), 1.0);
        const double force = value(Value::force);
        pair.force_a_nN = three(value(Value::force_a0), value(Value::force_a1), force);
        pair.force_b_nN = three(value(Value::force_b0), value(Value::force_b1), force);
        pairs.push_back(pair);
    }
}

template <class T> void set_side(const PackedTriangles<T>& triangles, int cell,
                                 const NodeBox& other, lanes::Side<T>& side) {
    const std::size_t first = static_cast<std::size_t>(cell) * triangles.n_triangles;
    const Vec3& origin = triangles.origin_um[static_cast<std::size_t>(cell)];
    side.record = triangles.record.data() + first * lanes::k_record;
    for (std::size_t k = 0; k < 3; ++k) {
        const auto component = static_cast<Eigen::Index>(k);
        side.centroid[k] = triangles.centroid_um[k].data() + first;
        side.normal[k] = triangles.normal[k].data() + first;
        side.other_low[k] = static_cast<T>(other.low[component] - origin[component]);
        side.other_high[k] = static_cast<T>(other.high[component] - origin[component]);
    }
    side.reach = triangles.reach_um.data() + first;
}

template <class T>
lanes::Buffers<T> buffers_in(KernelWorkspace<T>& workspace, std::size_t n_triangles) {
    const std::size_t n = n_triangles + lanes::k_block;
    const std::size_t n_blocks = n / lanes::k_block + lanes::k_max_lanes;
    // A row of A, a vector, and what is between two flushes.
    const std::size_t survivors = n + lanes::k_max_lanes + k_survivors;
    const auto sized = [](auto& array, std::size_t size) {
        if (array.size() < size) array.resize(size);
        return array.data();
    };
    lanes::Buffers<T> buffers{};
    buffers.near_a = sized(workspace.near_a, n);
    buffers.near_b = sized(workspace.near_b, n);
    for (std::size_t k = 0; k < 3; ++k) {
        buffers.centroid_b[k] = sized(workspace.centroid_um[k], n);
        buffers.normal_b[k] = sized(workspace.normal[k], n);
        buffers.block_centre[k] = sized(workspace.block_centre_um[k], n_blocks);
    }
    buffers.extent_a = sized(workspace.extent_a_um, n);
    buffers.extent_b = sized(workspace.extent_b_um, n);
    buffers.open_block = sized(workspace.open_block, n_blocks);
    buffers.reach_b = sized(workspace.reach_um, n);
    buffers.block_reach = sized(workspace.block_reach_um, n_blocks);
    buffers.survivor_a = sized(workspace.survivor_a, survivors);
    buffers.survivor_b = sized(workspace.survivor_b, survivors);
    buffers.survivors = survivors;
    return buffers;
}

template <class T>
KernelCounts find(const PackedTriangles<T>& triangles, const std::vector<NodeBox>& boxes,
                  int cell_a, int cell_b, const ContactLaw& law, double reach_um,
                  KernelWorkspace<T>& workspace, std::vector<ContactPair>& pairs) {
    const auto a = static_cast<std::size_t>(cell_a), b = static_cast<std::size_t>(cell_b);
    lanes::Task<T> task{};
    task.n_triangles = triangles.n_triangles;
    set_side(triangles, cell_a, boxes[b], task.a);
    set_side(triangles, cell_b, boxes[a], task.b);
    const Vec3 offset = triangles.origin_um[b] - triangles.origin_um[a];
    const double distance = offset.norm();
    // Cells in one place have no direction; any one will do.
    const Vec3 direction = distance > 0.0 ? Vec3(offset / -distance) : Vec3::UnitX();
    for (std::size_t k = 0; k < 3; ++k) {
        task.offset[k] = static_cast<T>(offset[static_cast<Eigen::Index>(k)]);
        task.direction[k] = static_cast<T>(direction[static_cast<Eigen::Index>(k)]);
    }
    task.reach = static_cast<T>(reach_um);
    task.h0 = static_cast<T>(law.h0_um);
    task.P0 = static_cast<T>(law.P0_kPa);
    task.k = static_cast<T>(law.k_kPa_per_um);
    task.reject_cos = static_cast<T>(law.reject_cos);
    task.largest_overlap = static_cast<T>(law.largest_overlap_um);
    Collected collected{&pairs};
    const lanes::Sink<T> sink{&collect<T>, &collected};
    const lanes::Buffers<T> buffers = buffers_in(workspace, triangles.n_triangles);
    std::size_t n_candidates = 0;
    if constexpr (sizeof(T) == sizeof(float))
        n_candidates = HWY_DYNAMIC_DISPATCH(lanes::find_pairs_float)(task, buffers, sink);
    else
        n_candidates = HWY_DYNAMIC_DISPATCH(lanes::find_pairs_double)(task, buffers, sink);
    return {static_cast<std::int64_t>(n_candidates), collected.too_deep};
}

}  // namespace

KernelCounts find_pairs_of_cells(const PackedTriangles<float>& triangles,
                                 const std::vector<NodeBox>& boxes, int cell_a, int cell_b,
                                 const ContactLaw& law, double reach_um,
                                 KernelWorkspace<float>& workspace,
                                 std::vector<ContactPair>& pairs) {
    return find(triangles, boxes, cell_a, cell_b, law, reach_um, workspace, pairs);
}

KernelCounts find_pairs_of_cells(const PackedTriangles<double>& triangles,
                                 const std::vector<NodeBox>& boxes, int cell_a, int cell_b,
                                 const ContactLaw& law, double reach_um,
                                 KernelWorkspace<double>& workspace,
                                 std::vector<ContactPair>& pairs) {
    return find(triangles, boxes, cell_a, cell_b, law, reach_um, workspace, pairs);
}

}  // namespace spheroscope
#endif
