#pragma once

#include "engine/base/vec3.hpp"
#include "engine/contact/pair_lanes.hpp"
#include "engine/model/geometry.hpp"
#include "engine/model/model.hpp"

#include <algorithm>
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
        thread_local std::vector<std::array<T, 3>> local;  // positions of the cell's nodes
        local.resize(x.size());
        for (std::size_t i = 0; i < x.size(); ++i) local[i] = in_lanes(x[i] - origin);
        for (std::size_t t = 0; t < n_triangles; ++t) {
            const std::size_t g = c * n_triangles + t;
            T* out = record.data() + g * k_record;
            const auto& nodes = model.topology->triangles[t];
            for (const int node : nodes)
                out = std::ranges::copy(local[static_cast<std::size_t>(node)], out).out;
            const std::array<T, 3> n = in_lanes(geometry.normal[g]);
            const std::array<T, 3> middle = in_lanes(geometry.centroid_um[g] - origin);
            std::ranges::copy(n, out);
            for (std::size_t k = 0; k < 3; ++k) {
                normal[k][g] = n[k];
                centroid_um[k][g] = middle[k];
            }
            reach_um[g] = static_cast<T>(geometry.reach_um[g]);
        }
    }

  private:
    static std::array<T, 3> in_lanes(const Vec3& v) {
        return {static_cast<T>(v.x()), static_cast<T>(v.y()), static_cast<T>(v.z())};
    }
};

}  // namespace spheroscope
