#pragma once

#include "engine/base/vec3.hpp"

#include <array>
#include <memory>
#include <span>
#include <vector>

namespace spheroscope {

/// The connectivity that all cells of a scene share: an icosahedron, subdivided n times.
/// Indices are local to a cell: node 0..n_nodes-1, triangle 0..n_triangles-1.
struct MeshTopology {
    /// Counter-clockwise seen from outside.
    using Triangle = std::array<int, 3>;

    ///        a          Triangle `left` is (i, j, a), triangle `right` is (j, i, b);
    ///       / .         both counter-clockwise seen from outside. i < j.
    ///      i---j
    ///       . /
    ///        b
    struct Edge {
        int i, j, a, b;
        int left, right;
    };

    int n_subdivisions = 0;
    std::vector<Triangle> triangles;
    std::vector<Edge> edges;
    /// Neighbours of node i: neighbours[neighbour_begin[i] .. neighbour_begin[i + 1]), ascending.
    std::vector<int> neighbour_begin, neighbours;
    /// Triangles around node i, ascending: as above.
    std::vector<int> triangle_begin, node_triangles;
    /// The mesh of a cell of radius 1 um: nodes on one sphere about the origin, scaled so that the
    /// volume of the polyhedron is 4/3 pi. A cell of radius R starts as R times this.
    std::vector<Vec3> unit_shape;

    [[nodiscard]] int n_nodes() const { return static_cast<int>(unit_shape.size()); }
    [[nodiscard]] int n_triangles() const { return static_cast<int>(triangles.size()); }
    [[nodiscard]] int n_edges() const { return static_cast<int>(edges.size()); }
};

/// The mesh sizes that a scene may ask for: 42, 162, 642, 2562 nodes (1 to 4 subdivisions).
inline constexpr std::array<int, 4> k_mesh_sizes{42, 162, 642, 2562};

/// Builds the mesh with that many nodes per cell. Precondition: n_nodes is one of k_mesh_sizes.
[[nodiscard]] std::shared_ptr<const MeshTopology> make_icosphere(int n_nodes);

/// Builds connectivity from triangles alone (test sheets excepted: the surface must be closed).
/// Throws Error when an edge does not have exactly two triangles that run along it in opposite
/// directions: then the surface is open, non-manifold or has mixed winding.
[[nodiscard]] MeshTopology make_closed_topology(std::vector<MeshTopology::Triangle> triangles,
                                                std::vector<Vec3> shape);

/// Volume enclosed by a closed mesh, um^3; negative if the winding is inward.
[[nodiscard]] double enclosed_volume(std::span<const MeshTopology::Triangle> triangles,
                                     std::span<const Vec3> x_um);

}  // namespace spheroscope
