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

Mat3 square(const std::array<float, 3>& v) {
    const Vec3 d = VectorTraits<Vec3>::from(v);
    return d * d.transpose();
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

template <class Vector> void CellStiffness::add_any_product(double factor,
                                                            std::span<const Vector> u,
                                                            std::span<Vector> out) const {
    using Traits = VectorTraits<Vector>;
    using Scalar = typename Traits::Scalar;
    const auto f = static_cast<Scalar>(factor);
    for (const Edge& e : edges) {
        const Vector t = Traits::from(e.direction);
        const Vector relative = u[e.i] - u[e.j];
        const Vector force =
            (f * Scalar{e.isotropic}) * relative + (f * Scalar{e.along} * t.dot(relative)) * t;
        out[e.i] += force;
        out[e.j] -= force;
    }
    for (const Normal& e : normals) {
        const Vector n = Traits::from(e.normal);
        const Vector& u2 = u[e.nodes[2]];
        const Scalar d0 = n.dot(u[e.nodes[0]] - u2);
        const Scalar d1 = n.dot(u[e.nodes[1]] - u2);
        const Scalar first = f * (Scalar{e.p} * d0 + Scalar{e.q} * d1);
        const Scalar second = f * (Scalar{e.r} * d1);
        const Scalar y0 = Scalar{e.p} * first;
        const Scalar y1 = Scalar{e.q} * first + Scalar{e.r} * second;
        out[e.nodes[0]] += y0 * n;
        out[e.nodes[1]] += y1 * n;
        out[e.nodes[2]] -= (y0 + y1) * n;
    }
    for (const Triangle& e : triangles) {
        Scalar s{};
        for (std::size_t m = 0; m < 3; ++m) s += Traits::from(e.gradient[m]).dot(u[e.nodes[m]]);
        s *= f * Scalar{e.coefficient};
        for (std::size_t m = 0; m < 3; ++m) out[e.nodes[m]] += s * Traits::from(e.gradient[m]);
    }
    for (const Hinge& e : hinges) {
        const auto& [i, j, a, b] = e.nodes;
        const Vector by_a = Traits::from(e.by_a), by_b = Traits::from(e.by_b);
        const Vector along = u[j] - u[i];
        const Scalar turn = by_a.dot(u[a] - u[i] - Scalar{e.foot_a} * along) +
                            by_b.dot(u[b] - u[i] - Scalar{e.foot_b} * along);
        const Scalar s = f * Scalar{e.coefficient} * turn;
        const Vector at_a = s * by_a, at_b = s * by_b;
        const Vector at_j = Scalar{e.foot_a} * at_a + Scalar{e.foot_b} * at_b;
        out[a] += at_a;
        out[b] += at_b;
        out[j] -= at_j;
        out[i] += at_j - (at_a + at_b);
    }
    for (const Node& e : nodes) {
        const Vector n = Traits::from(e.direction);
        out[e.node] += (f * Scalar{e.coefficient} * n.dot(u[e.node])) * n;
    }
}

void CellStiffness::add_product(double factor, std::span<const Vec3> u, std::span<Vec3> out) const {
    add_any_product(factor, u, out);
}

void CellStiffness::add_product(double factor, std::span<const Lanes> u,
                                std::span<Lanes> out) const {
    add_any_product(factor, u, out);
}

void CellStiffness::add_diagonal(double factor, std::span<Mat3> blocks) const {
    for (const Edge& e : edges) {
        const Mat3 block = factor * (double{e.isotropic} * Mat3::Identity() +
                                     double{e.along} * square(e.direction));
        blocks[e.i] += block;
        blocks[e.j] += block;
    }
    for (const Normal& e : normals) {
        const Mat3 nn = factor * square(e.normal);
        const double p = double{e.p}, q = double{e.q}, r = double{e.r};
        blocks[e.nodes[0]] += (p * p) * nn;
        blocks[e.nodes[1]] += (q * q + r * r) * nn;
        blocks[e.nodes[2]] += ((p + q) * (p + q) + r * r) * nn;
    }
    for (const Triangle& e : triangles)
        for (std::size_t m = 0; m < 3; ++m)
            blocks[e.nodes[m]] += (factor * double{e.coefficient}) * square(e.gradient[m]);
    for (const Hinge& e : hinges) {
        const HingeSlope slope{VectorTraits<Vec3>::from(e.by_a), VectorTraits<Vec3>::from(e.by_b),
                               double{e.foot_a}, double{e.foot_b}};
        const std::array<Vec3, 4> g = slope.gradient();
        for (std::size_t m = 0; m < 4; ++m)
            blocks[e.nodes[m]] += (factor * double{e.coefficient}) * g[m] * g[m].transpose();
    }
    for (const Node& e : nodes)
        blocks[e.node] += (factor * double{e.coefficient}) * square(e.direction);
}

}  // namespace spheroscope
