#include "engine/friction/cortex_viscosity.hpp"

#include <cmath>

namespace spheroscope {

double edge_friction_nN_s_per_um(double eta_kPa_s, double thickness_um) {
    return eta_kPa_s * thickness_um / std::sqrt(3.0);
}

void add_cortex_friction(const MeshTopology& mesh, double edge_friction, std::span<const Vec3> u,
                         std::span<Vec3> out) {
    for (std::size_t i = 0; i < u.size(); ++i) {
        const auto begin = static_cast<std::size_t>(mesh.neighbour_begin[i]);
        const auto end = static_cast<std::size_t>(mesh.neighbour_begin[i + 1]);
        Vec3 sum = static_cast<double>(end - begin) * u[i];
        for (std::size_t k = begin; k < end; ++k)
            sum -= u[static_cast<std::size_t>(mesh.neighbours[k])];
        out[i] += edge_friction * sum;
    }
}

}  // namespace spheroscope
