#include "engine/model/prolongation.hpp"

#include "engine/base/error.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace spheroscope {
namespace {

/// The node across an edge from a given one: wing of the triangle on the edge's other side.
class Opposite {
  public:
    explicit Opposite(const MeshTopology& mesh) {
        for (const MeshTopology::Edge& e : mesh.edges) wings_[{e.i, e.j}] = {e.a, e.b};
    }
    [[nodiscard]] std::pair<int, int> of_edge(int i, int j) const {
        return wings_.at(std::minmax(i, j));
    }
    [[nodiscard]] int across(int i, int j, int from) const {
        const auto [a, b] = of_edge(i, j);
        return a == from ? b : a;
    }

  private:
    std::map<std::pair<int, int>, std::pair<int, int>> wings_;
};

}  // namespace

Prolongation::Prolongation(std::shared_ptr<const MeshTopology> coarse,
                           std::shared_ptr<const MeshTopology> fine)
    : coarse_(std::move(coarse)), fine_(std::move(fine)) {
    std::shared_ptr<const MeshTopology> from = coarse_;
    while (from->n_nodes() < fine_->n_nodes()) {
        // Every edge gets a node, and every triangle becomes four.
        const int n_next = from->n_nodes() + static_cast<int>(from->edges.size());
        const auto to = n_next == fine_->n_nodes() ? fine_ : make_icosphere(n_next);
        const Opposite opposite(*from);
        std::vector<Middle>& level = levels_.emplace_back();
        for (int node = from->n_nodes(); node < n_next; ++node) {
            // The ends of its edge are its only neighbours that are old.
            std::vector<int> ends;
            for (int k = to->neighbour_begin[idx(node)]; k < to->neighbour_begin[idx(node) + 1];
                 ++k)
                if (to->neighbours[idx(k)] < from->n_nodes())
                    ends.push_back(to->neighbours[idx(k)]);
            SPHEROSCOPE_ASSERT(ends.size() == 2, "a new node lies in the middle of an old edge");
            const int i = ends[0], j = ends[1];
            const auto [a, b] = opposite.of_edge(i, j);
            level.push_back({{i, j, a, b, opposite.across(i, a, j), opposite.across(a, j, i),
                              opposite.across(i, b, j), opposite.across(b, j, i)}});
        }
        n_parts_ *= 4;
        from = to;
    }
    SPHEROSCOPE_ASSERT(from->n_nodes() == fine_->n_nodes(),
                       "the fine mesh is a subdivision of the coarse one");
}

std::vector<Vec3> Prolongation::positions(std::span<const Vec3> coarse_um) const {
    std::vector<Vec3> x(coarse_um.begin(), coarse_um.end());
    x.reserve(idx(fine_->n_nodes()));
    for (const std::vector<Middle>& level : levels_)
        for (const Middle& m : level) {
            const auto& [i, j, a, b, c, d, e, f] = m.nodes;
            x.push_back(0.5 * (x[idx(i)] + x[idx(j)]) + 0.125 * (x[idx(a)] + x[idx(b)]) -
                        0.0625 * (x[idx(c)] + x[idx(d)] + x[idx(e)] + x[idx(f)]));
        }
    Vec3 centroid = Vec3::Zero();
    for (const Vec3& node : x) centroid += node;
    centroid /= static_cast<double>(x.size());
    const double scale = std::cbrt(enclosed_volume(coarse_->triangles, coarse_um) /
                                   enclosed_volume(fine_->triangles, x));
    for (Vec3& node : x) node = centroid + scale * (node - centroid);
    return x;
}

std::vector<Vec3> prolonged_positions(const Prolongation& prolongation, int n_cells,
                                      std::span<const Vec3> coarse_um) {
    const std::size_t n = idx(prolongation.coarse().n_nodes());
    std::vector<Vec3> x;
    x.reserve(idx(n_cells) * idx(prolongation.fine().n_nodes()));
    for (int cell = 0; cell < n_cells; ++cell) {
        const std::vector<Vec3> of_cell =
            prolongation.positions(coarse_um.subspan(idx(cell) * n, n));
        x.insert(x.end(), of_cell.begin(), of_cell.end());
    }
    return x;
}

}  // namespace spheroscope
