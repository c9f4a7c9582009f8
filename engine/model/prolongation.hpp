#pragma once

#include "engine/base/index.hpp"
#include "engine/model/model.hpp"

#include <memory>
#include <span>
#include <vector>

namespace spheroscope {

/// Carries what is known on a cell's mesh over to a finer one that was made of it by subdivision.
///
/// Old nodes keep their place; a new one, in the middle of an old edge, is put where the surface
/// through the old nodes is, by the butterfly scheme (Dyn, Levin and Gregory 1990):
///
///     c --- a --- d
///      .   / .   /       1/2 (i + j) + 1/8 (a + b) - 1/16 (c + d + e + f)
///       . /   . /
///        i -*- j         so that a flat contact stays flat and a free surface stays round
///       / .   / .        (the plain middle of an edge would lie below it).
///      /   . /   .
///     e --- b --- f
class Prolongation {
  public:
    /// Throws an assertion unless `fine` is `coarse` subdivided some times.
    Prolongation(std::shared_ptr<const MeshTopology> coarse,
                 std::shared_ptr<const MeshTopology> fine);

    /// Positions of one cell, fine [n_nodes of fine] from coarse [n_nodes of coarse]; then scaled
    /// about the centroid so that the enclosed volume is what it was.
    [[nodiscard]] std::vector<Vec3> positions(std::span<const Vec3> coarse_um) const;
    /// Values at the nodes of one cell: middles take the mean of the ends of their edge.
    template <class T> [[nodiscard]] std::vector<T> node_values(std::span<const T> coarse) const {
        std::vector<T> values(coarse.begin(), coarse.end());
        for (const std::vector<Middle>& level : levels_)
            for (const Middle& m : level)
                values.push_back(
                    static_cast<T>(0.5F * (values[idx(m.nodes[0])] + values[idx(m.nodes[1])])));
        return values;
    }
    /// Triangle of the coarse mesh that a triangle of the fine one is a part of.
    [[nodiscard]] int parent(int fine_triangle) const { return fine_triangle / n_parts_; }

    [[nodiscard]] const MeshTopology& coarse() const { return *coarse_; }
    [[nodiscard]] const MeshTopology& fine() const { return *fine_; }

  private:
    struct Middle {
        std::array<int, 8> nodes;  ///< i, j, a, b, and the four wings
    };

    std::shared_ptr<const MeshTopology> coarse_, fine_;
    std::vector<std::vector<Middle>> levels_;  ///< per subdivision, in the order of the new nodes
    int n_parts_ = 1;
};

/// Positions of all cells [all nodes of `fine`'s mesh].
[[nodiscard]] std::vector<Vec3> prolonged_positions(const Prolongation& prolongation, int n_cells,
                                                    std::span<const Vec3> coarse_um);

}  // namespace spheroscope
