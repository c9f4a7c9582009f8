#include "engine/forces/cell_stiffness.hpp"

#include <algorithm>
#include <cmath>

namespace spheroscope {
namespace {

using Index = CellStiffness::Index;

std::array<float, 3> single(const Vec3& v) {
    return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

template <std::size_t N> std::array<Index, N> indices(const std::array<int, N>& nodes) {
    std::array<Index, N> result;
    std::transform(nodes.begin(), nodes.end(), result.begin(),
                   [](int node) { return static_cast<Index>(node); });
    return result;
}

}  // namespace

CellStiffness::Edge::Edge(int node_i, int node_j, double isotropic_nN_per_um,
                          double along_nN_per_um, const Vec3& t)
    : direction(single(t)), along(static_cast<float>(along_nN_per_um)),
      isotropic(static_cast<float>(isotropic_nN_per_um)), i(static_cast<Index>(node_i)),
      j(static_cast<Index>(node_j)) {}

CellStiffness::Normal::Normal(const std::array<int, 3>& n,
                              const std::array<double, 3>& weights_nN_per_um,
                              const Vec3& unit_normal)
    : normal(single(unit_normal)), p(0.0F), q(0.0F), r(0.0F), nodes(indices(n)) {
    const auto& [w0, w1, w2] = weights_nN_per_um;
    // Cholesky factor of the form's 2x2 matrix (w1 + w2, -w2; -w2, w0 + w2).
    const double square_of_p = w1 + w2;
    if (!(square_of_p > 0.0)) return;
    p = static_cast<float>(std::sqrt(square_of_p));
    q = static_cast<float>(-w2 / std::sqrt(square_of_p));
    r = static_cast<float>(std::sqrt(std::max(0.0, (w0 * w1 + w1 * w2 + w2 * w0) / square_of_p)));
}

CellStiffness::Triangle::Triangle(const std::array<int, 3>& n, const std::array<Vec3, 3>& g,
                                  double factor)
    : gradient{single(g[0]), single(g[1]), single(g[2])}, coefficient(static_cast<float>(factor)),
      nodes(indices(n)) {}

CellStiffness::Hinge::Hinge(const std::array<int, 4>& n, const HingeSlope& slope, double factor)
    : by_a(single(slope.by_a)), foot_a(static_cast<float>(slope.foot_a)), by_b(single(slope.by_b)),
      foot_b(static_cast<float>(slope.foot_b)), coefficient(static_cast<float>(factor)),
      nodes(indices(n)) {}

HingeSlope CellStiffness::Hinge::slope() const {
    return {VectorTraits<Vec3>::from(by_a), VectorTraits<Vec3>::from(by_b), double{foot_a},
            double{foot_b}};
}

CellStiffness::Node::Node(int n, double coefficient_nN_per_um, const Vec3& unit)
    : direction(single(unit)), coefficient(static_cast<float>(coefficient_nN_per_um)),
      node(static_cast<Index>(n)) {}

void CellStiffness::clear() {
    edges.clear();
    normals.clear();
    triangles.clear();
    hinges.clear();
    nodes.clear();
}

void CellStiffness::add_product(double factor, std::span<const Vec3> u, std::span<Vec3> out) const {
    const auto vec3 = [](const std::array<float, 3>& v) { return VectorTraits<Vec3>::from(v); };
    for (const Edge& e : edges) {
        const Vec3 t = vec3(e.direction);
        const Vec3 relative = u[e.i] - u[e.j];
        const Vec3 force =
            factor * (double{e.isotropic} * relative + double{e.along} * t.dot(relative) * t);
        out[e.i] += force;
        out[e.j] -= force;
    }
    for (const Normal& e : normals) {
        const Vec3 n = vec3(e.normal);
        const double d0 = n.dot(u[e.nodes[0]] - u[e.nodes[2]]);
        const double d1 = n.dot(u[e.nodes[1]] - u[e.nodes[2]]);
        const double first = factor * (double{e.p} * d0 + double{e.q} * d1);
        const double second = factor * (double{e.r} * d1);
        const double y0 = double{e.p} * first;
        const double y1 = double{e.q} * first + double{e.r} * second;
        out[e.nodes[0]] += y0 * n;
        out[e.nodes[1]] += y1 * n;
        out[e.nodes[2]] -= (y0 + y1) * n;
    }
    for (const Triangle& e : triangles) {
        double s = 0.0;
        for (std::size_t m = 0; m < 3; ++m) s += vec3(e.gradient[m]).dot(u[e.nodes[m]]);
        s *= factor * double{e.coefficient};
        for (std::size_t m = 0; m < 3; ++m) out[e.nodes[m]] += s * vec3(e.gradient[m]);
    }
    for (const Hinge& e : hinges) {
        const std::array<Vec3, 4> g = e.slope().gradient();
        double turn = 0.0;
        for (std::size_t m = 0; m < 4; ++m) turn += g[m].dot(u[e.nodes[m]]);
        const double s = factor * double{e.coefficient} * turn;
        for (std::size_t m = 0; m < 4; ++m) out[e.nodes[m]] += s * g[m];
    }
    for (const Node& e : nodes) {
        const Vec3 n = vec3(e.direction);
        out[e.node] += factor * double{e.coefficient} * n.dot(u[e.node]) * n;
    }
}

}  // namespace spheroscope
