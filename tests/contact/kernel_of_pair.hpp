#pragma once

#include "engine/contact/pair_kernel.hpp"
#include "engine/contact/triangle_pair.hpp"

namespace spheroscope::test {

/// Two cells of one triangle each, as the SIMD kernel reads them.
template <class T> struct TwoTriangles {
    PackedTriangles<T> packed;
    std::vector<NodeBox> boxes;

    TwoTriangles(const TriangleGeometry& a, const TriangleGeometry& b) {
        packed.n_triangles = 1;
        packed.record.resize(2 * lanes::k_record);
        packed.reach_um.resize(1 + lanes::k_max_lanes);
        for (std::size_t k = 0; k < 3; ++k) {
            packed.centroid_um[k].resize(1 + lanes::k_max_lanes);
            packed.normal[k].resize(1 + lanes::k_max_lanes);
        }
        add(a);
        add(b);
    }

    PairOutcome outcome(const ContactLaw& law, double reach_um, ContactPair& pair) const {
        KernelWorkspace<T> workspace;
        std::vector<ContactPair> pairs;
        const KernelCounts counts =
            find_pairs_of_cells(packed, boxes, 0, 1, law, reach_um, workspace, pairs);
        if (counts.too_deep > 0) return PairOutcome::too_deep;
        if (pairs.empty()) return PairOutcome::apart;
        pair = pairs.front();
        return PairOutcome::active;
    }

  private:
    void add(const TriangleGeometry& triangle) {
        const std::size_t cell = boxes.size();
        const NodeBox box(triangle.corner_um);
        const Vec3 origin = 0.5 * (box.low + box.high);
        const Vec3 centroid =
            (triangle.corner_um[0] + triangle.corner_um[1] + triangle.corner_um[2]) / 3.0;
        double reach_um = 0.0;
        T* out = packed.record.data() + cell * lanes::k_record;
        for (const Vec3& x : triangle.corner_um) {
            reach_um = std::max(reach_um, (x - centroid).norm());
            for (Eigen::Index k = 0; k < 3; ++k) *out++ = static_cast<T>(x[k] - origin[k]);
        }
        for (std::size_t k = 0; k < 3; ++k) {
            const auto component = static_cast<Eigen::Index>(k);
            *out++ = packed.normal[k][cell] = static_cast<T>(triangle.normal[component]);
            packed.centroid_um[k][cell] = static_cast<T>(centroid[component] - origin[component]);
        }
        packed.reach_um[cell] = static_cast<T>(reach_um);
        packed.origin_um.push_back(origin);
        boxes.push_back(box);
    }
};

}  // namespace spheroscope::test
