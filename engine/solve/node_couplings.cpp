#include "engine/solve/node_couplings.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace spheroscope {

NodeCouplings::NodeCouplings(const MeshTopology& mesh) {
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
}

}  // namespace spheroscope
