#include "engine/forces/cell_stiffness.hpp"

namespace spheroscope {
namespace {

std::size_t idx(int i) { return static_cast<std::size_t>(i); }

template <std::size_t N>
void add_rank_one_products(const std::vector<CellStiffness::RankOne<N>>& elements, double factor,
                           std::span<const Vec3> u, std::span<Vec3> out) {
    for (const CellStiffness::RankOne<N>& e : elements) {
        double s = 0.0;
        for (std::size_t m = 0; m < N; ++m) s += e.gradient[m].dot(u[idx(e.nodes[m])]);
        s *= factor * e.coefficient;
        for (std::size_t m = 0; m < N; ++m) out[idx(e.nodes[m])] += s * e.gradient[m];
    }
}

template <std::size_t N>
void add_rank_one_diagonals(const std::vector<CellStiffness::RankOne<N>>& elements, double factor,
                            std::span<Mat3> blocks) {
    for (const CellStiffness::RankOne<N>& e : elements)
        for (std::size_t m = 0; m < N; ++m)
            blocks[idx(e.nodes[m])] +=
                (factor * e.coefficient) * e.gradient[m] * e.gradient[m].transpose();
}

}  // namespace

void CellStiffness::clear() {
    edges.clear();
    normals.clear();
    rank_one_3.clear();
    rank_one_4.clear();
    nodes.clear();
}

void CellStiffness::add_product(double factor, std::span<const Vec3> u, std::span<Vec3> out) const {
    for (const Edge& e : edges) {
        const Vec3 relative = u[idx(e.i)] - u[idx(e.j)];
        const Vec3 f = (factor * e.isotropic) * relative +
                       (factor * e.along * e.direction.dot(relative)) * e.direction;
        out[idx(e.i)] += f;
        out[idx(e.j)] -= f;
    }
    for (const Normal& e : normals) {
        const double w0 = e.normal.dot(u[idx(e.nodes[0])]);
        const double w1 = e.normal.dot(u[idx(e.nodes[1])]);
        const double w2 = e.normal.dot(u[idx(e.nodes[2])]);
        const double s0 = factor * e.weights[0] * (w1 - w2);
        const double s1 = factor * e.weights[1] * (w2 - w0);
        const double s2 = factor * e.weights[2] * (w0 - w1);
        out[idx(e.nodes[0])] += (s2 - s1) * e.normal;
        out[idx(e.nodes[1])] += (s0 - s2) * e.normal;
        out[idx(e.nodes[2])] += (s1 - s0) * e.normal;
    }
    add_rank_one_products(rank_one_3, factor, u, out);
    add_rank_one_products(rank_one_4, factor, u, out);
    for (const Node& e : nodes)
        out[idx(e.node)] +=
            (factor * e.coefficient * e.direction.dot(u[idx(e.node)])) * e.direction;
}

void CellStiffness::add_diagonal(double factor, std::span<Mat3> blocks) const {
    for (const Edge& e : edges) {
        const Mat3 block = (factor * e.isotropic) * Mat3::Identity() +
                           (factor * e.along) * e.direction * e.direction.transpose();
        blocks[idx(e.i)] += block;
        blocks[idx(e.j)] += block;
    }
    for (const Normal& e : normals) {
        const Mat3 nn = factor * e.normal * e.normal.transpose();
        blocks[idx(e.nodes[0])] += (e.weights[1] + e.weights[2]) * nn;
        blocks[idx(e.nodes[1])] += (e.weights[2] + e.weights[0]) * nn;
        blocks[idx(e.nodes[2])] += (e.weights[0] + e.weights[1]) * nn;
    }
    add_rank_one_diagonals(rank_one_3, factor, blocks);
    add_rank_one_diagonals(rank_one_4, factor, blocks);
    for (const Node& e : nodes)
        blocks[idx(e.node)] += (factor * e.coefficient) * e.direction * e.direction.transpose();
}

}  // namespace spheroscope
