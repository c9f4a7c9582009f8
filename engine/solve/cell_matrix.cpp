#include "engine/solve/cell_matrix.hpp"

#include "engine/base/index.hpp"

#include <algorithm>

namespace spheroscope {
namespace {

using Register = Lanes::Register;

std::array<float, 3> single(const Vec3& v) {
    return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

/// A vector as the rows of an outer product, laid out as the nine numbers of a block are.
struct AsRows {
    Register first, second;  // x y z x, y z x y
    float last;              // z
    explicit AsRows(const std::array<float, 3>& v)
        : first{v[0], v[1], v[2], v[0]}, second{v[1], v[2], v[0], v[1]}, last(v[2]) {}
};
/// factor times a vector as its columns.
struct AsColumns {
    Register first, second;  // x x x y, y y z z
    float last;              // z
    AsColumns(float factor, const std::array<float, 3>& v) {
        const float x = factor * v[0], y = factor * v[1], z = factor * v[2];
        first = Register{x, x, x, y};
        second = Register{y, y, z, z};
        last = z;
    }
};
/// rows * columns^T
struct Outer {
    Register first, second;
    float last;
    Outer(const AsRows& rows, const AsColumns& columns)
        : first(rows.first * columns.first), second(rows.second * columns.second),
          last(rows.last * columns.last) {}
};

/// block += isotropic * 1 + factor * outer
void add(Block3& block, const Outer& outer, float factor, float isotropic = 0.0F) {
    float* const b = block.column_major.data();
    Register first = lane_detail::load(b), second = lane_detail::load(b + 4);
    first += Register{isotropic, 0.0F, 0.0F, 0.0F};
    second += Register{isotropic, 0.0F, 0.0F, 0.0F};
    first += factor * outer.first;
    second += factor * outer.second;
    lane_detail::store(first, b);
    lane_detail::store(second, b + 4);
    b[8] = (b[8] + isotropic) + factor * outer.last;
}

/// n n^T
Outer square(const std::array<float, 3>& n) { return {AsRows(n), AsColumns(1.0F, n)}; }

/// The N vectors of a squared form and -factor times them, for the blocks between its nodes.
template <std::size_t N> struct SquaredForm {
    std::array<std::array<float, 3>, N> g;
    float minus_factor;

    void add_to(std::span<Block3> blocks, const auto& places) const {
        std::size_t pair = 0;
        for (std::size_t m = 0; m < N; ++m)
            for (std::size_t n = m + 1; n < N; ++n, ++pair) {
                const auto& place = places[pair];
                const std::size_t row = place.is_swapped ? n : m, column = place.is_swapped ? m : n;
                add(blocks[place.block], Outer(AsRows(g[row]), AsColumns(minus_factor, g[column])),
                    1.0F);
            }
    }
};

}  // namespace

template <std::size_t N> const typename CellMatrix::Places<N>::OfElement&
CellMatrix::Places<N>::find(std::size_t element, const Nodes& nodes,
                            const NodeCouplings& couplings) {
    if (element >= entries_.size()) entries_.resize(element + 1);  // all nodes 0: no element's
    Entry& entry = entries_[element];
    bool is_known = true;
    for (std::size_t m = 0; m < N; ++m) is_known &= entry.nodes[m] == nodes[m];
    if (is_known) return entry.places;
    entry.nodes = nodes;
    std::size_t pair = 0;
    for (std::size_t m = 0; m < N; ++m)
        for (std::size_t n = m + 1; n < N; ++n, ++pair) {
            const auto [low, high] = std::minmax(nodes[m], nodes[n]);
            entry.places[pair] = {static_cast<std::uint32_t>(couplings.pair(low, high)),
                                  nodes[m] > nodes[n]};
        }
    return entry.places;
}

void CellMatrix::clear(const NodeCouplings& couplings) {
    if (serial_ != couplings.serial()) *this = CellMatrix();
    serial_ = couplings.serial();
    couplings_ = &couplings;
    blocks_.assign(couplings.n_pairs(), Block3{});
    walls_.clear();
}

void CellMatrix::add(const CellStiffness& K, double factor) {
    const auto f = static_cast<float>(factor);
    for (std::size_t n = 0; n < K.edges.size(); ++n) {
        const CellStiffness::Edge& e = K.edges[n];
        const Place place = edges_.find(n, {e.i, e.j}, *couplings_)[0];
        spheroscope::add(blocks_[place.block],
                         Outer(AsRows(e.direction), AsColumns(f * e.along, e.direction)), 1.0F,
                         f * e.isotropic);
    }
    for (std::size_t n = 0; n < K.normals.size(); ++n) {
        // (p d + q e)^2 + (r e)^2 with d = n.(u_0 - u_2), e = n.(u_1 - u_2)
        const CellStiffness::Normal& e = K.normals[n];
        const auto& [at_01, at_02, at_12] = normals_.find(n, e.nodes, *couplings_);
        const float pq = f * e.p * e.q;
        const Outer nn = square(e.normal);
        spheroscope::add(blocks_[at_01.block], nn, -pq);
        spheroscope::add(blocks_[at_02.block], nn, f * e.p * e.p + pq);
        spheroscope::add(blocks_[at_12.block], nn, pq + f * (e.q * e.q + e.r * e.r));
    }
    for (std::size_t n = 0; n < K.triangles.size(); ++n) {
        const CellStiffness::Triangle& e = K.triangles[n];
        SquaredForm<3>{e.gradient, -(f * e.coefficient)}.add_to(
            blocks_, triangles_.find(n, e.nodes, *couplings_));
    }
    for (std::size_t n = 0; n < K.hinges.size(); ++n) {
        const CellStiffness::Hinge& e = K.hinges[n];
        const std::array<Vec3, 4> gradient = e.slope().gradient();
        SquaredForm<4> form{{}, -(f * e.coefficient)};
        std::transform(gradient.begin(), gradient.end(), form.g.begin(), single);
        form.add_to(blocks_, hinges_.find(n, e.nodes, *couplings_));
    }
    for (const CellStiffness::Node& e : K.nodes) {
        walls_.push_back(e);
        walls_.back().coefficient *= f;
    }
}

void CellMatrix::add_laplacian(const MeshTopology& mesh, double strength) {
    for (const MeshTopology::Edge& e : mesh.edges)
        blocks_[couplings_->pair(e.i, e.j)].add_isotropic(static_cast<float>(strength));
}

void CellMatrix::add_between(int triangle, const std::array<double, 3>& weights,
                             const Vec3& direction, double factor) {
    const Outer nn = square(single(direction));
    const std::array<std::uint32_t, 3>& pairs = couplings_->pairs_of_triangle(triangle);
    std::size_t pair = 0;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = i + 1; k < 3; ++k, ++pair)
            spheroscope::add(blocks_[pairs[pair]], nn,
                             static_cast<float>(-factor * weights[i] * weights[k]));
}

}  // namespace spheroscope
