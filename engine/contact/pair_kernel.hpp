#pragma once

#include "engine/contact/contact_law.hpp"
#include "engine/contact/contacts.hpp"
#include "engine/contact/node_box.hpp"
#include "engine/contact/packed_triangles.hpp"
#include "engine/contact/pair_lanes.hpp"

#include <array>
#include <cstdint>
#include <vector>

// The fast contact kernel: contact_of_triangles (triangle_pair.hpp) for many pairs at once, one
// pair in each SIMD lane. Two stages for each pair of cells:
//
//   filter   the triangles of A and B that can touch the other cell, in the order of their indices;
//            then each of A against blocks of B: normals, spheres, planes, circles along n; then
//            corners against edges and planes, which leaves 1.1 candidates for each active pair
//   clip     the survivors side by side: edges of A^p clipped by B^p and delta >= 0, edges of B^p
//            by A^p, moments by Green's theorem, nodal forces
//
// Both go through pairs in the canonical order, so nothing is sorted, and no lane looks at another
// one: the result of a pair depends on the pair alone.

namespace spheroscope {

/// Lane type of the kernel: 24 or 53 binary digits.
enum class ContactPrecision { single_precision, double_precision };

/// What one pair of cells has cost.
struct KernelCounts {
    std::int64_t candidates = 0;  ///< pairs that reached the clip
    std::int64_t too_deep = 0;    ///< left out as passed-through surfaces
};

/// Memory of one thread, kept from call to call.
template <class T> struct KernelWorkspace {
    using Index = lanes::IndexOf<T>;
    std::vector<Index> near_a, near_b;
    std::array<std::vector<T>, 3> centroid_um, normal, block_centre_um;
    std::vector<T> reach_um, block_reach_um, extent_a_um, extent_b_um;
    std::vector<Index> open_block, survivor_a, survivor_b;
};

/// Appends the active pairs of two cells to `pairs`, ascending by (triangle_a, triangle_b).
/// boxes [cells]: around the nodes of each. reach_um: largest distance of two surfaces that make a
/// contact. Runs on the SIMD target that is in use (simd_target.hpp).
[[nodiscard]] KernelCounts find_pairs_of_cells(const PackedTriangles<float>& triangles,
                                               const std::vector<NodeBox>& boxes, int cell_a,
                                               int cell_b, const ContactLaw& law, double reach_um,
                                               KernelWorkspace<float>& workspace,
                                               std::vector<ContactPair>& pairs);
[[nodiscard]] KernelCounts find_pairs_of_cells(const PackedTriangles<double>& triangles,
                                               const std::vector<NodeBox>& boxes, int cell_a,
                                               int cell_b, const ContactLaw& law, double reach_um,
                                               KernelWorkspace<double>& workspace,
                                               std::vector<ContactPair>& pairs);

}  // namespace spheroscope
