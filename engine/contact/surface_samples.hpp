#pragma once

#include "engine/model/model.hpp"

#include <array>
#include <span>
#include <vector>

namespace spheroscope {

/// Points on the surface of a cell at which the contact law `variational` looks for the other
/// surface. Every edge is cut into m parts and every triangle into m^2 equal ones (m = 3 below);
/// samples on an edge or a node belong to all triangles around it.
///
///          2
///         / .          local samples of a triangle by rows from the side (0, 1): the weights of
///        +---+         its corners are multiples of 1/m
///       / . / .
///      +---+---+
///     / . / . / .
///    0---+---+---1
struct SurfaceSamples {
    /// A sample lies at sum weights[k] x(nodes[k]), the corners of the first triangle that has it.
    struct Sample {
        std::array<int, 3> nodes;
        std::array<double, 3> weights;
    };
    int parts_per_edge = 1;  ///< m
    std::vector<Sample> samples;
    int n_per_triangle = 3;        ///< (m + 1)(m + 2) / 2
    std::vector<int> of_triangle;  ///< [n_triangles * n_per_triangle] into `samples`
    std::vector<std::array<double, 3>> local_weights;  ///< [n_per_triangle] in the triangle itself
    std::vector<std::array<int, 3>> parts;             ///< [m^2] corners, local samples

    [[nodiscard]] std::span<const int> samples_of(int triangle) const {
        const auto n = static_cast<std::size_t>(n_per_triangle);
        return std::span(of_triangle).subspan(static_cast<std::size_t>(triangle) * n, n);
    }
};

[[nodiscard]] SurfaceSamples make_surface_samples(const MeshTopology& mesh, int parts_per_edge);

/// m for which samples of the largest cell at rest are no farther apart than the range of adhesion,
/// 2 h0, but at least 2. Coarser ones do not resolve the rim of a contact, and with m = 1 the nodes
/// of one cell, which are the only samples then, catch in the valleys of the other one
/// (engine/README.md, 'The law variational').
[[nodiscard]] int samples_per_edge(const Model& model, double h0_um);

}  // namespace spheroscope
