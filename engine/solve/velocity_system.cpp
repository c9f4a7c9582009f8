#include "engine/solve/velocity_system.hpp"

#include "engine/base/index.hpp"
#include "engine/friction/cortex_viscosity.hpp"

namespace spheroscope {

template <class Vector> void VelocitySystem::product_of_team(int team,
                                                             std::span<const Vector> u_all,
                                                             std::span<Vector> out_all) const {
    using Scalar = typename VectorTraits<Vector>::Scalar;
    const CellTeams::Range team_cells = teams().cells_of(team);
    const std::size_t n_nodes = idx(model.n_nodes());
    const std::size_t first = idx(team_cells.begin) * n_nodes;
    const std::size_t n_all = idx(team_cells.end - team_cells.begin) * n_nodes;
    const std::span<Vector> out_of_team = out_all.subspan(first, n_all);
    for (std::size_t i = 0; i < n_all; ++i)
        out_of_team[i] = static_cast<Scalar>(drag_nN_s_per_um[first + i]) * u_all[first + i];
    if (cells != nullptr) cells->add_product(team, u_all.subspan(first, n_all), out_of_team);
    for (int cell = team_cells.begin; cell < team_cells.end; ++cell) {
        const std::span<const Vector> u = model.cell_nodes(u_all, cell);
        const std::span<Vector> out = model.cell_nodes(out_all, cell);
        if (cells == nullptr && edge_nN_s_per_um > 0.0)
            add_cortex_friction(*model.topology, edge_nN_s_per_um, u, out);
        if (!volume_kPa_s_per_um3.empty()) {
            const std::span<const Vector> s = volume_gradient<Vector>(cell);
            Scalar volume_rate{};
            for (std::size_t i = 0; i < n_nodes; ++i) volume_rate += s[i].dot(u[i]);
            const Scalar strength =
                static_cast<Scalar>(volume_kPa_s_per_um3[idx(cell)]) * volume_rate;
            for (std::size_t i = 0; i < n_nodes; ++i) out[i] += strength * s[i];
        }
        if (!pairs.empty()) pairs.add_to_cell(cell, out);
    }
}

template void VelocitySystem::product_of_team(int, std::span<const Vec3>, std::span<Vec3>) const;
template void VelocitySystem::product_of_team(int, std::span<const Lanes>, std::span<Lanes>) const;

void VelocitySystem::product(std::span<const Vec3> u, std::span<Vec3> out, Workers& workers) const {
    workers.loop(n_groups(), [&](int group) { product_of_group(group, u); });
    workers.loop(teams().n_teams(), [&](int team) { product_of_team(team, u, out); });
}

}  // namespace spheroscope
