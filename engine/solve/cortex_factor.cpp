#include "engine/solve/cortex_factor.hpp"

#include "engine/base/error.hpp"

namespace spheroscope {

CortexFactor::CortexFactor(const MeshTopology& mesh, std::span<const double> drag_nN_s_per_um,
                           double edge_nN_s_per_um) {
    std::vector<SparseCholesky::Entry> entries;
    for (std::size_t i = 0; i < drag_nN_s_per_um.size(); ++i) {
        const int degree = mesh.neighbour_begin[i + 1] - mesh.neighbour_begin[i];
        const int node = static_cast<int>(i);
        entries.push_back({node, node, drag_nN_s_per_um[i] + edge_nN_s_per_um * degree});
    }
    for (const MeshTopology::Edge& e : mesh.edges) entries.push_back({e.j, e.i, -edge_nN_s_per_um});
    [[maybe_unused]] const bool is_definite =
        factor_.factor(static_cast<int>(drag_nN_s_per_um.size()), entries);
    SPHEROSCOPE_ASSERT(is_definite, "the friction matrix of a cell is positive definite");
}

}  // namespace spheroscope
