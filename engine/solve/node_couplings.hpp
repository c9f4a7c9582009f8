#pragma once

#include "engine/model/mesh_topology.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace spheroscope {

/// The pairs of nodes that a cell's own terms can couple: the ends of every edge, and the two wings
/// of every hinge. All cells of a mesh share it. Pair number first(i) + k is (i, others(i)[k]).
class NodeCouplings {
  public:
    explicit NodeCouplings(const MeshTopology& mesh);
    NodeCouplings(const NodeCouplings&) = delete;
    NodeCouplings& operator=(const NodeCouplings&) = delete;

    [[nodiscard]] int n_nodes() const { return static_cast<int>(begin_.size()) - 1; }
    [[nodiscard]] std::size_t n_pairs() const { return other_.size(); }
    [[nodiscard]] std::size_t first(int i) const { return begin_[static_cast<std::size_t>(i)]; }
    /// The partners of node i that come after it, ascending.
    [[nodiscard]] std::span<const std::uint16_t> others(int i) const {
        return std::span(other_).subspan(first(i), first(i + 1) - first(i));
    }
    /// Number of the pair (i, j). Precondition: i < j, and they are coupled.
    [[nodiscard]] std::size_t pair(int i, int j) const {
        // Counting the smaller ones has no branch to mispredict, and goes eight at a time.
        const std::uint16_t* const row = padded_.data() + static_cast<std::size_t>(i) * width_;
        std::uint16_t n_smaller = 0;
        for (std::size_t k = 0; k < width_; ++k)
            n_smaller = static_cast<std::uint16_t>(n_smaller + (row[k] < j ? 1 : 0));
        return first(i) + n_smaller;
    }
    /// Numbers of the pairs of a triangle's corners: (0, 1), (0, 2), (1, 2).
    [[nodiscard]] const std::array<std::uint32_t, 3>& pairs_of_triangle(int triangle) const {
        return of_triangle_[static_cast<std::size_t>(triangle)];
    }
    /// No other object of this class has the same; what is remembered of one belongs to it alone.
    [[nodiscard]] std::uint64_t serial() const { return serial_; }

  private:
    std::uint64_t serial_;
    std::vector<std::size_t> begin_;    // [n_nodes + 1]
    std::vector<std::uint16_t> other_;  // [n_pairs]
    std::size_t width_ = 0;             // of the longest row, a multiple of 8
    std::vector<std::uint16_t>
        padded_;  // [n_nodes x width_] rows of other_, then the largest value
    std::vector<std::array<std::uint32_t, 3>> of_triangle_;
};

}  // namespace spheroscope
