#include "engine/statistics/tension_by_region.hpp"

#include "engine/base/index.hpp"

#include <cmath>
#include <limits>
#include <optional>

namespace spheroscope::statistics {
namespace {

/// What surrounds the nodes of one cell.
struct NodeSurroundings {
    std::vector<double> area_um2;
    std::vector<Vec3> normal;  ///< outward, not of unit length
    std::vector<char> touches;
};

NodeSurroundings surroundings_of(const Aggregate& aggregate, int cell) {
    const MeshTopology& mesh = *aggregate.topology;
    const std::size_t n_nodes = idx(mesh.n_nodes());
    NodeSurroundings around{std::vector<double>(n_nodes, 0.0),
                            std::vector<Vec3>(n_nodes, Vec3::Zero()),
                            std::vector<char>(n_nodes, 0)};
    const Vec3* x = aggregate.x_um.data() + idx(cell) * n_nodes;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto& nodes = mesh.triangles[t];
        const std::size_t triangle = idx(cell) * mesh.triangles.size() + t;
        const Vec3 normal = (x[nodes[1]] - x[nodes[0]]).cross(x[nodes[2]] - x[nodes[0]]);
        for (const int node : nodes) {
            around.area_um2[idx(node)] += aggregate.triangle_area_um2[triangle] / 3.0;
            around.normal[idx(node)] += normal;
            if (!std::isnan(aggregate.sigma_nn_kPa[triangle])) around.touches[idx(node)] = 1;
        }
    }
    return around;
}

std::optional<Region> region_of(bool is_core, bool touches, double cos_outward) {
    if (is_core) return touches ? Region::core : Region::pore_wall;
    if (!touches && cos_outward > 0.0) return Region::rim;
    if (touches && cos_outward < -0.5) return Region::inner_face;
    return {};
}

}  // namespace

std::string_view name_of(Region region) {
    switch (region) {
    case Region::rim: return "rim";
    case Region::inner_face: return "inner face of the rim";
    case Region::core: return "core";
    case Region::pore_wall: return "pore walls";
    }
    return "";
}

std::array<double, 4> tension_by_region(const Aggregate& aggregate) {
    constexpr double undefined = std::numeric_limits<double>::quiet_NaN();
    if (aggregate.gamma_eff_nN_per_um.empty()) return {undefined, undefined, undefined, undefined};
    std::array<double, 4> sum{}, area_um2{};
    const std::size_t n_nodes = idx(aggregate.topology->n_nodes());
    for (int cell = 0; cell < aggregate.n_cells(); ++cell) {
        const NodeSurroundings around = surroundings_of(aggregate, cell);
        for (std::size_t i = 0; i < n_nodes; ++i) {
            const std::size_t node = idx(cell) * n_nodes + i;
            const Vec3 outward = aggregate.x_um[node] - aggregate.middle_um;
            const double cos_outward =
                around.normal[i].dot(outward) / (around.normal[i].norm() * outward.norm());
            const auto region =
                region_of(aggregate.is_core(cell), around.touches[i] != 0, cos_outward);
            if (!region) continue;
            const auto r = static_cast<std::size_t>(*region);
            sum[r] += around.area_um2[i] * aggregate.gamma_eff_nN_per_um[node];
            area_um2[r] += around.area_um2[i];
        }
    }
    std::array<double, 4> mean{};
    for (std::size_t r = 0; r < mean.size(); ++r)
        mean[r] = area_um2[r] > 0.0 ? sum[r] / area_um2[r] : undefined;
    return mean;
}

}  // namespace spheroscope::statistics
