#pragma once

#include "engine/base/lanes.hpp"
#include "engine/base/vec3.hpp"
#include "engine/forces/hinge_slope.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace spheroscope {

/// The stiffness of one cell's own terms, as lists of small positive semi-definite elements. A term
/// that is absent leaves its list empty, and an empty list costs nothing. Node indices are local to
/// the cell. What is solved with is their sum (engine/solve/cell_matrix.hpp).
///
/// Elements are in single precision. That is harmless, because K is an approximation, and any K
/// leads to the same end state; every element stays symmetric and positive semi-definite whatever
/// its numbers are rounded to.
class CellStiffness {
  public:
    using Index = std::uint16_t;

    /// u -> (isotropic * 1 + along * t t^T)(u_i - u_j): a spring.
    struct Edge {
        std::array<float, 3> direction;  ///< t, unit
        float along, isotropic;          ///< nN/um, isotropic >= 0 and isotropic + along >= 0
        Index i, j;
        Edge(int node_i, int node_j, double isotropic_nN_per_um, double along_nN_per_um,
             const Vec3& t);
    };
    /// The normal part of a tension, sum over the sides of weight * (n . (u_a - u_b))^2. In the
    /// differences d = n . (u_0 - u_2) and e = n . (u_1 - u_2) that is (p d + q e)^2 + (r e)^2: a
    /// sum of squares also when an obtuse corner makes one of the weights negative.
    struct Normal {
        std::array<float, 3> normal;
        float p, q, r;  ///< sqrt(nN/um)
        std::array<Index, 3> nodes;
        /// weights[k] belongs to the side opposite of node k; the sum must be >= 0 for any u.
        Normal(const std::array<int, 3>& n, const std::array<double, 3>& weights_nN_per_um,
               const Vec3& unit_normal);
    };
    /// coefficient * g g^T with g over the three nodes of a triangle.
    struct Triangle {
        std::array<std::array<float, 3>, 3> gradient;
        float coefficient;
        std::array<Index, 3> nodes;
        Triangle(const std::array<int, 3>& n, const std::array<Vec3, 3>& g, double factor);
    };
    /// coefficient * g g^T with g the gradient of a hinge's angle: by_a and by_b at the wings a and
    /// b, and at the ends j and i of the edge what keeps the sum zero, shared by the feet of the
    /// wings on the edge.
    struct Hinge {
        std::array<float, 3> by_a;
        float foot_a;
        std::array<float, 3> by_b;
        float foot_b;
        float coefficient;
        std::array<Index, 4> nodes;  ///< i, j, a, b
        Hinge(const std::array<int, 4>& n, const HingeSlope& slope, double factor);
        [[nodiscard]] HingeSlope slope() const;
    };
    /// coefficient * n n^T on one node.
    struct Node {
        std::array<float, 3> direction;
        float coefficient;
        Index node;
        Node(int n, double coefficient_nN_per_um, const Vec3& unit);
    };

    std::vector<Edge> edges;
    std::vector<Normal> normals;
    std::vector<Triangle> triangles;
    std::vector<Hinge> hinges;
    std::vector<Node> nodes;

    void clear();
    /// out += factor * K u; both [n_nodes of the cell].
    void add_product(double factor, std::span<const Vec3> u, std::span<Vec3> out) const;
};

}  // namespace spheroscope
