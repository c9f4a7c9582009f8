#include "engine/solve/cell_matrices.hpp"

#include "engine/base/index.hpp"

#include <array>

namespace spheroscope {
namespace {

using Register = Lanes::Register;

constexpr std::size_t k_numbers = 9;  // of a block
constexpr auto k_members = static_cast<std::size_t>(CellTeams::k_members);
static_assert(sizeof(Register) == k_members * sizeof(float));

/// One node of four cells: a coordinate in each register, a cell in each lane.
struct NodeOfFour {
    Register x, y, z;
};

NodeOfFour side_by_side(Register a, Register b, Register c, Register d) {
    const Register xy_ab = __builtin_shufflevector(a, b, 0, 4, 1, 5);
    const Register xy_cd = __builtin_shufflevector(c, d, 0, 4, 1, 5);
    const Register zw_ab = __builtin_shufflevector(a, b, 2, 6, 3, 7);
    const Register zw_cd = __builtin_shufflevector(c, d, 2, 6, 3, 7);
    return {__builtin_shufflevector(xy_ab, xy_cd, 0, 1, 4, 5),
            __builtin_shufflevector(xy_ab, xy_cd, 2, 3, 6, 7),
            __builtin_shufflevector(zw_ab, zw_cd, 0, 1, 4, 5)};
}

/// The other way round: vectors of the four cells, each with a fourth lane of zero.
std::array<Register, 4> one_by_one(const NodeOfFour& node) {
    const Register zero{};
    const Register xy_ab = __builtin_shufflevector(node.x, node.y, 0, 4, 1, 5);
    const Register xy_cd = __builtin_shufflevector(node.x, node.y, 2, 6, 3, 7);
    const Register z_ab = __builtin_shufflevector(node.z, zero, 0, 4, 1, 5);
    const Register z_cd = __builtin_shufflevector(node.z, zero, 2, 6, 3, 7);
    return {__builtin_shufflevector(xy_ab, z_ab, 0, 1, 4, 5),
            __builtin_shufflevector(xy_ab, z_ab, 2, 3, 6, 7),
            __builtin_shufflevector(xy_cd, z_cd, 0, 1, 4, 5),
            __builtin_shufflevector(xy_cd, z_cd, 2, 3, 6, 7)};
}

/// y += blocks * u for four cells: u, y [n_nodes], blocks [pairs][9][4]. Each lane does what
/// products(const float*, Lanes) does.
void add_product_of_four(const NodeCouplings& couplings, const float* blocks, const NodeOfFour* u,
                         NodeOfFour* y) {
    for (int i = 0; i < couplings.n_nodes(); ++i) {
        const NodeOfFour at_i = u[i];
        NodeOfFour sum{};
        for (const std::uint16_t j : couplings.others(i)) {
            const auto b = [blocks](std::size_t k) {
                return lane_detail::load(blocks + k * k_members);
            };
            const Register dx = at_i.x - u[j].x, dy = at_i.y - u[j].y, dz = at_i.z - u[j].z;
            sum.x += (b(0) * dx + b(3) * dy) + b(6) * dz;
            sum.y += (b(1) * dx + b(4) * dy) + b(7) * dz;
            sum.z += (b(2) * dx + b(5) * dy) + b(8) * dz;
            y[j].x -= (b(0) * dx + b(1) * dy) + b(2) * dz;
            y[j].y -= (b(3) * dx + b(4) * dy) + b(5) * dz;
            y[j].z -= (b(6) * dx + b(7) * dy) + b(8) * dz;
            blocks += k_numbers * k_members;
        }
        y[i].x += sum.x;
        y[i].y += sum.y;
        y[i].z += sum.z;
    }
}

}  // namespace

void CellMatrices::allocate(const NodeCouplings& couplings, int n_cells) {
    couplings_ = &couplings;
    teams_ = CellTeams(n_cells);
    blocks_.resize(k_numbers * couplings.n_pairs() * idx(n_cells));
    walls_.resize(idx(n_cells));
}

void CellMatrices::set(int team, std::span<const CellMatrix> matrices) {
    const CellTeams::Range cells = teams_.cells_of(team);
    const std::size_t n_cells = matrices.size();
    float* const first = blocks_.data() + k_numbers * couplings_->n_pairs() * idx(cells.begin);
    for (std::size_t c = 0; c < n_cells; ++c) {
        const std::span<const Block3> blocks = matrices[c].blocks();
        float* out = first + c;
        for (const Block3& block : blocks)
            for (const float number : block.column_major) {
                *out = number;
                out += n_cells;
            }
        const std::span<const CellStiffness::Node> walls = matrices[c].walls();
        walls_[idx(cells.begin) + c].assign(walls.begin(), walls.end());
    }
}

Block3 CellMatrices::Blocks::at(std::size_t pair) const {
    Block3 block;
    for (std::size_t k = 0; k < k_numbers; ++k)
        block.column_major[k] = first[(k_numbers * pair + k) * stride];
    return block;
}

CellMatrices::Blocks CellMatrices::of_cell(int cell) const {
    const CellTeams::Range cells = teams_.cells_of(teams_.team_of(cell));
    const std::size_t of_team = k_numbers * couplings_->n_pairs() * idx(cells.begin);
    return {blocks_.data() + of_team + idx(cell - cells.begin), idx(cells.end - cells.begin)};
}

template <class F> void CellMatrices::for_each_pair(int cell, const F& f) const {
    const Blocks blocks = of_cell(cell);
    std::size_t pair = 0;
    for (int i = 0; i < couplings_->n_nodes(); ++i)
        for (const std::uint16_t j : couplings_->others(i)) f(idx(i), j, blocks.at(pair++));
}

void CellMatrices::add_product(int team, std::span<const Vec3> u, std::span<Vec3> out) const {
    const CellTeams::Range cells = teams_.cells_of(team);
    const std::size_t n_nodes = idx(couplings_->n_nodes());
    for (int cell = cells.begin; cell < cells.end; ++cell) {
        const std::size_t first = idx(cell - cells.begin) * n_nodes;
        const std::span<const Vec3> u_of_cell = u.subspan(first, n_nodes);
        const std::span<Vec3> out_of_cell = out.subspan(first, n_nodes);
        const Blocks blocks = of_cell(cell);
        std::size_t pair = 0;
        for (std::size_t i = 0; i < n_nodes; ++i) {
            Vec3 sum = Vec3::Zero();
            for (const std::uint16_t j : couplings_->others(static_cast<int>(i))) {
                const BlockProducts<Vec3> p =
                    products(blocks.at(pair++), u_of_cell[i] - u_of_cell[j]);
                sum += p.straight;
                out_of_cell[j] -= p.transposed;
            }
            out_of_cell[i] += sum;
        }
        add_walls(cell, u_of_cell, out_of_cell);
    }
}

void CellMatrices::add_product(int team, std::span<const Lanes> u, std::span<Lanes> out) const {
    const CellTeams::Range cells = teams_.cells_of(team);
    const std::size_t n_nodes = idx(couplings_->n_nodes());
    const float* block = blocks_.data() + k_numbers * couplings_->n_pairs() * idx(cells.begin);
    if (cells.end - cells.begin == CellTeams::k_members) {
        thread_local std::vector<NodeOfFour> u_of_four, out_of_four;
        u_of_four.resize(n_nodes);
        out_of_four.resize(n_nodes);
        const auto of_node = [n_nodes](const auto& values, std::size_t i) {
            return side_by_side(values[i].lane, values[n_nodes + i].lane,
                                values[2 * n_nodes + i].lane, values[3 * n_nodes + i].lane);
        };
        for (std::size_t i = 0; i < n_nodes; ++i) {
            u_of_four[i] = of_node(u, i);
            out_of_four[i] = of_node(out, i);
        }
        add_product_of_four(*couplings_, block, u_of_four.data(), out_of_four.data());
        for (std::size_t i = 0; i < n_nodes; ++i) {
            const std::array<Register, 4> of_cells = one_by_one(out_of_four[i]);
            for (std::size_t c = 0; c < k_members; ++c) out[c * n_nodes + i] = Lanes(of_cells[c]);
        }
    } else {
        for (std::size_t i = 0; i < n_nodes; ++i) {
            const Lanes at_i = u[i];
            Lanes sum;
            for (const std::uint16_t j : couplings_->others(static_cast<int>(i))) {
                const BlockProducts<Lanes> p = products(block, at_i - u[j]);
                block += k_numbers;
                sum += p.straight;
                out[j] -= p.transposed;
            }
            out[i] += sum;
        }
    }
    for (int cell = cells.begin; cell < cells.end; ++cell) {
        const std::size_t first = idx(cell - cells.begin) * n_nodes;
        add_walls(cell, u.subspan(first, n_nodes), out.subspan(first, n_nodes));
    }
}

void CellMatrices::add_walls(int cell, std::span<const Vec3> u, std::span<Vec3> out) const {
    for (const CellStiffness::Node& e : walls_[idx(cell)]) {
        const Vec3 n = VectorTraits<Vec3>::from(e.direction);
        out[e.node] += (double{e.coefficient} * n.dot(u[e.node])) * n;
    }
}

void CellMatrices::add_walls(int cell, std::span<const Lanes> u, std::span<Lanes> out) const {
    for (const CellStiffness::Node& e : walls_[idx(cell)]) {
        const Lanes n = VectorTraits<Lanes>::from(e.direction);
        out[e.node] += (e.coefficient * n.dot(u[e.node])) * n;
    }
}

void CellMatrices::add_diagonal(int cell, std::span<Mat3> blocks) const {
    for_each_pair(cell, [&](std::size_t i, std::size_t j, const Block3& block) {
        const Mat3 W = block.mat3();
        blocks[i] += W;
        blocks[j] += W.transpose();
    });
    for (const CellStiffness::Node& e : walls_[idx(cell)]) {
        const Vec3 n = VectorTraits<Vec3>::from(e.direction);
        blocks[e.node] += double{e.coefficient} * n * n.transpose();
    }
}

Mat3 CellMatrices::against_translation(int cell) const {
    Mat3 sum = Mat3::Zero();
    for (const CellStiffness::Node& e : walls_[idx(cell)]) {
        const Vec3 n = VectorTraits<Vec3>::from(e.direction);
        sum += double{e.coefficient} * n * n.transpose();
    }
    return sum;
}

Mat3 CellMatrices::against_rotation(int cell, std::span<const Vec3> arm) const {
    // [d] W [d]^T with [d] u = d x u; only its symmetric part is left in the sum
    Mat3 sum = Mat3::Zero();
    for_each_pair(cell, [&](std::size_t i, std::size_t j, const Block3& block) {
        const Mat3 W = block.mat3();
        const Vec3 d = arm[j] - arm[i];
        const Mat3 from_left = W.colwise().cross(d);
        sum += from_left.rowwise().cross(d.transpose());
    });
    const Mat3 transposed = sum.transpose();
    sum = 0.5 * (sum + transposed);
    for (const CellStiffness::Node& e : walls_[idx(cell)]) {
        const Vec3 lever = arm[e.node].cross(VectorTraits<Vec3>::from(e.direction));
        sum += double{e.coefficient} * lever * lever.transpose();
    }
    return sum;
}

}  // namespace spheroscope
