#pragma once

#include "engine/model/mesh_topology.hpp"

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace spheroscope {

/// What never changes during a run: the mesh that all cells share, and every cell's size. All cells
/// are scaled copies of one rest shape, so rest quantities are stored once, for radius 1 um, and
/// scale with the cell's radius: lengths with R, areas with R^2, volumes with R^3, angles not at
/// all.
///
/// Arrays over nodes run cell by cell: node i of cell c is c * n_nodes + i.
struct Model {
    std::shared_ptr<const MeshTopology> topology;
    std::vector<double> radius_um;          ///< [n_cells]
    std::vector<double> target_volume_um3;  ///< [n_cells] V*
    // Rest state of the cell of radius 1 um.
    std::vector<double> unit_edge_length;      ///< [n_edges] d*
    std::vector<double> unit_triangle_area;    ///< [n_triangles] S*
    std::vector<double> unit_node_area;        ///< [n_nodes] a third of the adjacent S*
    std::vector<double> rest_hinge_angle_rad;  ///< [n_edges] theta*
    std::vector<double> rest_hinge_cosine;     ///< [n_edges] cos theta*
    std::vector<double> rest_hinge_sine;       ///< [n_edges] sin theta*
    double unit_area = 0.0;                    ///< sum of S*

    [[nodiscard]] int n_cells() const { return static_cast<int>(radius_um.size()); }
    [[nodiscard]] int n_nodes() const { return topology->n_nodes(); }
    [[nodiscard]] std::size_t n_all_nodes() const {
        return radius_um.size() * static_cast<std::size_t>(n_nodes());
    }
    [[nodiscard]] std::size_t n_all_triangles() const {
        return radius_um.size() * static_cast<std::size_t>(topology->n_triangles());
    }
    [[nodiscard]] double rest_volume_um3(int cell) const;  ///< 4/3 pi R^3, exact for the mesh

    /// A cell's part of an array over all nodes (or all triangles).
    template <class T> [[nodiscard]] std::span<T> cell_nodes(std::span<T> all, int cell) const {
        const auto n = static_cast<std::size_t>(n_nodes());
        return all.subspan(static_cast<std::size_t>(cell) * n, n);
    }
    template <class T> [[nodiscard]] std::span<T> cell_triangles(std::span<T> all, int cell) const {
        const auto n = static_cast<std::size_t>(topology->n_triangles());
        return all.subspan(static_cast<std::size_t>(cell) * n, n);
    }
};

/// Cells of these radii on this mesh, with V* = (1 + target_strain) * rest volume.
[[nodiscard]] Model make_model(std::shared_ptr<const MeshTopology> topology,
                               std::vector<double> radius_um, double target_strain = 0.0);

/// Signed angle between the two triangles of a hinge, rad, in (-pi, pi]: 0 flat, > 0 convex seen
/// from the side that the normals point to. By atan2, which keeps its digits near flat; acos would
/// not.
///        a
///       / .        left triangle (i, j, a), right triangle (j, i, b)
///      i---j
///       . /
///        b
[[nodiscard]] double hinge_angle(const Vec3& i, const Vec3& j, const Vec3& a, const Vec3& b);

}  // namespace spheroscope
