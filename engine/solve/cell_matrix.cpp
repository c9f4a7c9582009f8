#include "engine/solve/cell_matrix.hpp"

#include "engine/base/index.hpp"

#include <algorithm>

namespace spheroscope {
namespace {

std::array<float, 3> single(const Vec3& v) {
    return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

}  // namespace

void CellMatrix::clear(const NodeCouplings& couplings) {
    couplings_ = &couplings;
    blocks_.assign(couplings.n_pairs(), Block3{});
    nodes_.clear();
}

void CellMatrix::add(const CellStiffness& K, double factor) {
    const auto f = static_cast<float>(factor);
    for (const CellStiffness::Edge& e : K.edges) {
        Block3& W = block(e.i, e.j);
        W.add_isotropic(f * e.isotropic);
        W.add_outer(f * e.along, e.direction, e.direction);
    }
    for (const CellStiffness::Normal& e : K.normals) {
        // (p d + q e)^2 + (r e)^2 with d = n.(u_0 - u_2), e = n.(u_1 - u_2)
        const float pq = f * e.p * e.q;
        const auto& [n0, n1, n2] = e.nodes;
        Block3 nn;
        nn.add_outer(1.0F, e.normal, e.normal);
        block(n0, n1).add_square(-pq, nn);
        block(n0, n2).add_square(f * e.p * e.p + pq, nn);
        block(n1, n2).add_square(pq + f * (e.q * e.q + e.r * e.r), nn);
    }
    for (const CellStiffness::Triangle& e : K.triangles)
        for (std::size_t m = 0; m < 3; ++m)
            for (std::size_t n = m + 1; n < 3; ++n)
                add_square(e.nodes[m], e.nodes[n], f * e.coefficient, e.gradient[m], e.gradient[n]);
    for (const CellStiffness::Hinge& e : K.hinges) {
        const std::array<Vec3, 4> gradient = e.slope().gradient();
        std::array<std::array<float, 3>, 4> g;
        std::transform(gradient.begin(), gradient.end(), g.begin(), single);
        for (std::size_t m = 0; m < 4; ++m)
            for (std::size_t n = m + 1; n < 4; ++n)
                add_square(e.nodes[m], e.nodes[n], f * e.coefficient, g[m], g[n]);
    }
    for (const CellStiffness::Node& e : K.nodes) {
        nodes_.push_back(e);
        nodes_.back().coefficient *= f;
    }
}

void CellMatrix::add_laplacian(const MeshTopology& mesh, double strength) {
    for (const MeshTopology::Edge& e : mesh.edges)
        block(e.i, e.j).add_isotropic(static_cast<float>(strength));
}

void CellMatrix::add_between(const std::array<int, 3>& nodes, const std::array<double, 3>& weights,
                             const Vec3& direction, double factor) {
    Block3 nn;
    nn.add_outer(1.0F, single(direction), single(direction));
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = i + 1; k < 3; ++k)
            block(nodes[i], nodes[k])
                .add_square(static_cast<float>(-factor * weights[i] * weights[k]), nn);
}

template <class Vector>
void CellMatrix::add_any_product(std::span<const Vector> u, std::span<Vector> out) const {
    using Scalar = typename VectorTraits<Vector>::Scalar;
    for (int i = 0; i < couplings_->n_nodes(); ++i) {
        const Vector at_i = u[idx(i)];
        Vector sum = VectorTraits<Vector>::zero();
        const Block3* block = blocks_.data() + couplings_->first(i);
        for (const std::uint16_t j : couplings_->others(i)) {
            const Vector difference = at_i - u[j];
            const BlockProducts<Vector> p = products(*block++, difference);
            sum += p.straight;
            out[j] -= p.transposed;
        }
        out[idx(i)] += sum;
    }
    for (const CellStiffness::Node& e : nodes_) {
        const Vector n = VectorTraits<Vector>::from(e.direction);
        out[e.node] += (Scalar{e.coefficient} * n.dot(u[e.node])) * n;
    }
}

void CellMatrix::add_product(std::span<const Vec3> u, std::span<Vec3> out) const {
    add_any_product(u, out);
}

void CellMatrix::add_product(std::span<const Lanes> u, std::span<Lanes> out) const {
    add_any_product(u, out);
}

void CellMatrix::add_diagonal(std::span<Mat3> blocks) const {
    for (int i = 0; i < couplings_->n_nodes(); ++i) {
        const Block3* block = blocks_.data() + couplings_->first(i);
        for (const std::uint16_t j : couplings_->others(i)) {
            const Mat3 W = (block++)->mat3();
            blocks[idx(i)] += W;
            blocks[j] += W.transpose();
        }
    }
    for (const CellStiffness::Node& e : nodes_) {
        const Vec3 n = VectorTraits<Vec3>::from(e.direction);
        blocks[e.node] += double{e.coefficient} * n * n.transpose();
    }
}

Mat3 CellMatrix::against_translation() const {
    Mat3 sum = Mat3::Zero();
    for (const CellStiffness::Node& e : nodes_) {
        const Vec3 n = VectorTraits<Vec3>::from(e.direction);
        sum += double{e.coefficient} * n * n.transpose();
    }
    return sum;
}

Mat3 CellMatrix::against_rotation(std::span<const Vec3> arm) const {
    // [d] W [d]^T with [d] u = d x u; only its symmetric part is left in the sum
    Mat3 sum = Mat3::Zero();
    for (int i = 0; i < couplings_->n_nodes(); ++i) {
        const Block3* block = blocks_.data() + couplings_->first(i);
        for (const std::uint16_t j : couplings_->others(i)) {
            const Mat3 W = (block++)->mat3();
            const Vec3 d = arm[j] - arm[idx(i)];
            const Mat3 from_left = W.colwise().cross(d);
            sum += from_left.rowwise().cross(d.transpose());
        }
    }
    const Mat3 transposed = sum.transpose();
    sum = 0.5 * (sum + transposed);
    for (const CellStiffness::Node& e : nodes_) {
        const Vec3 lever = arm[e.node].cross(VectorTraits<Vec3>::from(e.direction));
        sum += double{e.coefficient} * lever * lever.transpose();
    }
    return sum;
}

}  // namespace spheroscope
