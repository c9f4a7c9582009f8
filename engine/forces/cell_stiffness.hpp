#pragma once

#include "engine/base/vec3.hpp"

#include <array>
#include <span>
#include <vector>

namespace spheroscope {

/// The stiffness of one cell's own terms, as lists of small positive semi-definite elements that
/// are applied without ever assembling a matrix. A term that is absent leaves its list empty, and
/// an empty list costs nothing. Node indices are local to the cell.
class CellStiffness {
  public:
    /// u -> (isotropic * 1 + along * t t^T)(u_i - u_j): a spring.
    struct Edge {
        int i, j;
        double isotropic, along;  ///< nN/um, both >= 0 or isotropic + along >= 0 and isotropic >= 0
        Vec3 direction;           ///< t, unit
    };
    /// sum over the three sides of cot * (n . (u_a - u_b))^2, the normal part of a tension:
    /// weights[k] belongs to the side opposite of node k.
    struct Normal {
        std::array<int, 3> nodes;
        std::array<double, 3> weights;  ///< nN/um
        Vec3 normal;
    };
    /// coefficient * g g^T with g over three or four nodes.
    template <std::size_t N> struct RankOne {
        std::array<int, N> nodes;
        std::array<Vec3, N> gradient;
        double coefficient;
    };
    /// coefficient * n n^T on one node.
    struct Node {
        int node;
        double coefficient;
        Vec3 direction;
    };

    std::vector<Edge> edges;
    std::vector<Normal> normals;
    std::vector<RankOne<3>> rank_one_3;
    std::vector<RankOne<4>> rank_one_4;
    std::vector<Node> nodes;

    void clear();
    /// out += factor * K u; both [n_nodes of the cell].
    void add_product(double factor, std::span<const Vec3> u, std::span<Vec3> out) const;
    /// Adds factor times the 3x3 diagonal blocks to `blocks` [n_nodes].
    void add_diagonal(double factor, std::span<Mat3> blocks) const;
};

}  // namespace spheroscope
