#pragma once

#include "engine/base/vec3.hpp"
#include "engine/forces/force_term.hpp"

#include <cstddef>
#include <span>

namespace spheroscope {

/// One cell of a configuration, as the loops of the terms read it: local indices, and the radius
/// that turns rest quantities of the unit cell into those of this one.
struct CellView {
    const Model& model;
    const MeshTopology& mesh;
    std::span<const Vec3> nodes_um;  ///< [n_nodes]
    double R_um;
    std::size_t first_triangle;  ///< of this cell in arrays over all triangles

    CellView(const Configuration& at, int cell)
        : model(at.model), mesh(*at.model.topology), nodes_um(at.model.cell_nodes(at.x_um, cell)),
          R_um(at.model.radius_um[static_cast<std::size_t>(cell)]),
          first_triangle(static_cast<std::size_t>(cell) *
                         static_cast<std::size_t>(at.model.topology->n_triangles())) {}

    [[nodiscard]] const Vec3& x(int node) const { return nodes_um[static_cast<std::size_t>(node)]; }
};

/// The entry of a local node in a cell's array.
template <class T> [[nodiscard]] T& at_node(std::span<T> values, int node) {
    return values[static_cast<std::size_t>(node)];
}

}  // namespace spheroscope
