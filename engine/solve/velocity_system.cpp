#include "engine/solve/velocity_system.hpp"

#include "engine/base/index.hpp"
#include "engine/friction/cortex_viscosity.hpp"

namespace spheroscope {

template <class Vector> void VelocitySystem::product_of_cell(int cell,
                                                             std::span<const Vector> u_all,
                                                             std::span<Vector> out) const {
    using Scalar = typename VectorTraits<Vector>::Scalar;
    const std::span<const Vector> u = model.cell_nodes(u_all, cell);
    const std::span<const double> d = model.cell_nodes(drag_nN_s_per_um, cell);
    for (std::size_t i = 0; i < u.size(); ++i) out[i] = static_cast<Scalar>(d[i]) * u[i];
    if (!cells.empty())
        cells[idx(cell)].add_product(u, out);
    else if (edge_nN_s_per_um > 0.0)
        add_cortex_friction(*model.topology, edge_nN_s_per_um, u, out);
    if (!volume_kPa_s_per_um3.empty()) {
        const std::span<const Vec3> s = model.cell_nodes(volume_gradient_um2, cell);
        Scalar volume_rate{};
        for (std::size_t i = 0; i < u.size(); ++i)
            volume_rate += VectorTraits<Vector>::from(s[i]).dot(u[i]);
        const Scalar strength = static_cast<Scalar>(volume_kPa_s_per_um3[idx(cell)]) * volume_rate;
        for (std::size_t i = 0; i < u.size(); ++i)
            out[i] += strength * VectorTraits<Vector>::from(s[i]);
    }
    if (!pairs.empty()) pairs.add_to_cell(cell, out);
}

template void VelocitySystem::product_of_cell(int, std::span<const Vec3>, std::span<Vec3>) const;
template void VelocitySystem::product_of_cell(int, std::span<const Lanes>, std::span<Lanes>) const;

void VelocitySystem::product(std::span<const Vec3> u, std::span<Vec3> out, Workers& workers) const {
    workers.loop(n_groups(), [&](int group) { product_of_group(group, u); });
    workers.loop(model.n_cells(),
                 [&](int cell) { product_of_cell(cell, u, model.cell_nodes(out, cell)); });
}

}  // namespace spheroscope
