#include "engine/solve/node_couplings.hpp"

#include <algorithm>
#include <atomic>
#include <limits>
#include <utility>

namespace spheroscope {

NodeCouplings::NodeCouplings(const MeshTopology& mesh) {
    static std::atomic<std::uint64_t> n_made{0};
    serial_ = ++n_made;
    std::vector<std::pair<int, int>> pairs;
    for (const MeshTopology::Edge& e : mesh.edges) {
        pairs.emplace_back(std::min(e.i, e.j), std::max(e.i, e.j));
        pairs.emplace_back(std::min(e.a, e.b), std::max(e.a, e.b));
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    begin_.assign(static_cast<std::size_t>(mesh.n_nodes()) + 1, 0);
    for (const auto& [i, j] : pairs) {
        ++begin_[static_cast<std::size_t>(i) + 1];
        other_.push_back(static_cast<std::uint16_t>(j));
    }
    for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
    for (int i = 0; i < n_nodes(); ++i) width_ = std::max(width_, (others(i).size() + 7) / 8 * 8);
    padded_.assign(static_cast<std::size_t>(n_nodes()) * width_,
                   std::numeric_limits<std::uint16_t>::max());
    for (int i = 0; i < n_nodes(); ++i)
        std::copy(others(i).begin(), others(i).end(),
                  padded_.begin() +
                      static_cast<std::ptrdiff_t>(static_cast<std::size_t>(i) * width_));
    for (const MeshTopology::Triangle& t : mesh.triangles) {
        const auto pair_of = [&](std::size_t m, std::size_t n) {
            return static_cast<std::uint32_t>(pair(std::min(t[m], t[n]), std::max(t[m], t[n])));
        };
        of_triangle_.push_back({pair_of(0, 1), pair_of(0, 2), pair_of(1, 2)});
    }
}

}  // namespace spheroscope
