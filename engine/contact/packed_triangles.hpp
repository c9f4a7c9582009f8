#pragma once

#include "engine/base/vec3.hpp"
#include "engine/contact/pair_lanes.hpp"
#include "engine/model/geometry.hpp"
#include "engine/model/model.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace spheroscope {

/// The triangles of all cells as the contact kernel reads them, T = float or double.
///
/// Positions are relative to the middle of the cell's own box, subtracted in double: a float then
/// has 2e-7 um on a cell of 5 um, wherever the cell is. Two cells meet by one more vector between
/// their origins, which is the same for all of their triangles.
template <class T> struct PackedTriangles {
    /// Numbers of one triangle side by side, one cache line of floats: corners 0, 1, 2 and the
    /// outward normal; the last four are not used.
    static constexpr std::size_t k_record = lanes::k_record;

    std::size_t n_triangles = 0;                ///< of each cell
    std::vector<Vec3> origin_um;                ///< [cells]
    std::vector<T> record;                      ///< [cells x n_triangles x k_record]
    std::array<std::vector<T>, 3> centroid_um;  ///< [cells x n_triangles]
    std::array<std::vector<T>, 3> normal;       ///< [cells x n_triangles]
    std::vector<T> reach_um;                    ///< [cells x n_triangles]

    void allocate(const Model& model) {
        n_triangles = model.topology->triangles.size();
        // Vectors are read whole, so beyond the last triangle as well.
        const std::size_t n = model.n_all_triangles() + lanes::k_max_lanes;
        origin_um.resize(model.radius_um.size());
        record.resize(n * k_record);
        for (std::vector<T>& component : centroid_um) component.resize(n);
        for (std::vector<T>& component : normal) component.resize(n);
        reach_um.resize(n);
    }

    /// Packs one cell. Cells are independent of each other.
    void pack_cell(const Model& model, std::span<const Vec3> x_um, const Geometry& geometry,
                   int cell, const Vec3& origin) {
        const auto c = static_cast<std::size_t>(cell);
        const std::span<const Vec3> x = model.cell_nodes(x_um, cell);
        origin_um[c] = origin;
        for (std::size_t t = 0; t < n_triangles; ++t) {
            const std::size_t g = c * n_triangles + t;
            T* out = record.data() + g * k_record;
            const auto& nodes = model.topology->triangles[t];
            for (std::size_t i = 0; i < 3; ++i) {
                const Vec3 local = x[static_cast<std::size_t>(nodes[i])] - origin;
                for (Eigen::Index k = 0; k < 3; ++k) *out++ = static_cast<T>(local[k]);
            }
            const Vec3 middle = geometry.centroid_um[g] - origin;
            for (std::size_t k = 0; k < 3; ++k) {
                const auto component = static_cast<Eigen::Index>(k);
                *out++ = normal[k][g] = static_cast<T>(geometry.normal[g][component]);
                centroid_um[k][g] = static_cast<T>(middle[component]);
            }
            reach_um[g] = static_cast<T>(geometry.reach_um[g]);
        }
    }
};

}  // namespace spheroscope
