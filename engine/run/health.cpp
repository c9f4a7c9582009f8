#include "engine/run/health.hpp"

#include "engine/contact/penetration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace spheroscope {
namespace {

/// Height over longest edge. The spring and hinge constants of such a triangle are a million times
/// those of its neighbours.
constexpr double k_flat = 1e-6;

/// Mean edges by which a node may be deeper inside another cell than contacts reach.
constexpr double k_edges = 0.25;

}  // namespace

std::optional<Trouble> cells_inside_each_other(System& system, std::span<const Vec3> x_um,
                                               const Loc& contact) {
    if (!system.parts().contact) return {};
    const ContactLaw& law = *system.parts().contact;
    const double reach_um = law.largest_overlap_um - 2.0 * law.h0_um;
    // A facet lies below the surface that it stands for: coarse cells seem to be inside each other
    // by a part of their edges where they only touch.
    const std::vector<double>& edges = system.model().unit_edge_length;
    const double mean_edge = std::accumulate(edges.begin(), edges.end(), 0.0) /
                             static_cast<double>(std::max<std::size_t>(1, edges.size()));
    const std::vector<double>& radii = system.model().radius_um;
    const double largest_um = *std::max_element(radii.begin(), radii.end());
    const double limit_um = reach_um + k_edges * mean_edge * largest_um;
    const auto found = deepest_penetration(system.model(), x_um, limit_um, system.workers());
    if (!found) return {};
    Trouble trouble;
    trouble.what = fmt::format("cells {} and {} lie inside each other, {:.3g} um deep: contacts do "
                               "not act beyond {:.3g} um",
                               found->other, found->cell, found->depth_um, reach_um);
    trouble.cell = found->cell;
    trouble.node = found->node;
    trouble.loc = contact;
    return trouble;
}

void name_flattest_triangle(const Model& model, std::span<const Vec3> x_um, Trouble& trouble) {
    if (trouble.cell >= 0) return;
    double flattest = k_flat;
    for (int cell = 0; cell < model.n_cells(); ++cell) {
        const std::span<const Vec3> x = model.cell_nodes(x_um, cell);
        for (const MeshTopology::Triangle& t : model.topology->triangles) {
            double longest_um = 0.0;
            std::size_t from = 0;
            const auto node = [&](std::size_t k) -> const Vec3& {
                return x[static_cast<std::size_t>(t[k % 3])];
            };
            for (std::size_t k = 0; k < 3; ++k) {
                const double length_um = (node(k + 1) - node(k)).norm();
                if (length_um > longest_um) {
                    longest_um = length_um;
                    from = k;
                }
            }
            const Vec3 along = node(from + 1) - node(from);
            const double height_um =
                along.cross(node(from + 2) - node(from)).norm() / std::max(longest_um, 1e-300);
            if (!(height_um < flattest * longest_um)) continue;
            flattest = height_um / longest_um;
            trouble.cell = cell;
            trouble.node = t[from];
            trouble.neighbour = t[(from + 1) % 3];
        }
    }
    if (trouble.cell >= 0)
        trouble.what +=
            fmt::format(" (a triangle is {:.2g} times as high as it is long)", flattest);
}

}  // namespace spheroscope
