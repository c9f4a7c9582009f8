#pragma once

#include "engine/base/huge_vector.hpp"
#include "engine/solve/cell_matrix.hpp"
#include "engine/solve/cell_teams.hpp"

#include <span>
#include <vector>

namespace spheroscope {

/// What couples the nodes within each cell in (Gamma + dt K), as the iterations of a solve read it:
/// a block W_ij per pair of nodes, y_i += W_ij (u_i - u_j), y_j -= W_ij^T (u_i - u_j).
///
/// The cells of a team of four have their blocks side by side, number by number. Their meshes are
/// the same, so a product does one node pair of all four with the instructions that one of them
/// alone would take: 2.5 times as fast, to the same bits.
class CellMatrices {
  public:
    /// Makes room; what was there is lost. `couplings` must outlive this object.
    void allocate(const NodeCouplings& couplings, int n_cells);
    [[nodiscard]] const CellTeams& teams() const { return teams_; }

    /// The matrices of a team's cells, in their order. Teams may be set at the same time.
    void set(int team, std::span<const CellMatrix> matrices);

    /// out += matrix * u; both [nodes of the team's cells, one cell after the other].
    void add_product(int team, std::span<const Vec3> u, std::span<Vec3> out) const;
    void add_product(int team, std::span<const Lanes> u, std::span<Lanes> out) const;
    /// Adds the 3x3 diagonal blocks of one cell to `blocks` [n_nodes].
    void add_diagonal(int cell, std::span<Mat3> blocks) const;
    /// What a cell has against moving all its nodes alike: T^T matrix T with T = (1, 1, ...).
    [[nodiscard]] Mat3 against_translation(int cell) const;
    /// The same of turning: R^T matrix R, where R_i omega = omega x arm[i], arm [n_nodes].
    [[nodiscard]] Mat3 against_rotation(int cell, std::span<const Vec3> arm) const;

  private:
    /// The blocks of one cell: number k of pair p is first[(9 p + k) stride].
    struct Blocks {
        const float* first;
        std::size_t stride;
        [[nodiscard]] Block3 at(std::size_t pair) const;
    };
    [[nodiscard]] Blocks of_cell(int cell) const;
    /// Calls f(i, j, block) for all pairs of nodes of a cell, in their order.
    template <class F> void for_each_pair(int cell, const F& f) const;
    void add_walls(int cell, std::span<const Vec3> u, std::span<Vec3> out) const;
    void add_walls(int cell, std::span<const Lanes> u, std::span<Lanes> out) const;

    const NodeCouplings* couplings_ = nullptr;
    CellTeams teams_;
    HugeVector<float> blocks_;  // [teams][pairs of nodes][9][cells of the team]
    std::vector<std::vector<CellStiffness::Node>> walls_;  // [cells] what sees a translation
};

}  // namespace spheroscope
