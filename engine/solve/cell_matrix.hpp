#pragma once

#include "engine/base/block3.hpp"
#include "engine/forces/cell_stiffness.hpp"
#include "engine/solve/node_couplings.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace spheroscope {

/// What couples the nodes of one cell in (Gamma + dt K), summed up from elements once per linear
/// solve: an iteration then reads one block per pair of nodes, whatever the number of terms. It is
/// multiplied with as one of CellMatrices.
///
/// Elements that do not see a common translation are stored as blocks W_ij on differences,
/// y_i += W_ij (u_i - u_j), y_j -= W_ij^T (u_i - u_j): rounding to single precision then does not
/// touch that blindness, and the symmetry only within a node's own 3x3 block (by 1e-8).
class CellMatrix {
  public:
    /// The zero matrix. `couplings` must outlive this object.
    void clear(const NodeCouplings& couplings);
    /// += factor * K
    void add(const CellStiffness& K, double factor);
    /// The same isotropic coupling on all edges of the mesh: += strength * Laplacian.
    void add_laplacian(const MeshTopology& mesh, double strength);
    /// += factor * g g^T with g = weights[k] * direction at the corners of a triangle, but without
    /// what the sum of the weights makes of it: for springs to nodes elsewhere, whose sum with
    /// these is zero.
    void add_between(int triangle, const std::array<double, 3>& weights, const Vec3& direction,
                     double factor);

    /// [pairs of nodes] W
    [[nodiscard]] std::span<const Block3> blocks() const { return blocks_; }
    /// What sees a translation: walls.
    [[nodiscard]] std::span<const CellStiffness::Node> walls() const { return walls_; }

  private:
    /// A block between two nodes of an element, and whether the first of them has the larger
    /// number.
    struct Place {
        std::uint32_t block;
        bool is_swapped;
    };
    /// Where the blocks of a list's elements are. The next cell has the same list, mostly: what was
    /// found for its element of the same number need only be compared.
    template <std::size_t N> class Places {
      public:
        using Nodes = std::array<CellStiffness::Index, N>;
        using OfElement = std::array<Place, N*(N - 1) / 2>;  // (0, 1), (0, 2) ... (1, 2) ...
        const OfElement& find(std::size_t element, const Nodes& nodes,
                              const NodeCouplings& couplings);

      private:
        struct Entry {
            Nodes nodes;
            OfElement places;
        };
        std::vector<Entry> entries_;
    };

    const NodeCouplings* couplings_ = nullptr;
    std::vector<Block3> blocks_;
    std::vector<CellStiffness::Node> walls_;
    std::uint64_t serial_ = 0;  // of the couplings whose places are remembered
    Places<2> edges_;
    Places<3> normals_, triangles_;
    Places<4> hinges_;
};

}  // namespace spheroscope
