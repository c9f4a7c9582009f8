#include "engine/friction/cortex_viscosity.hpp"

#include <cmath>

namespace spheroscope {
namespace {

template <class Vector> void add_laplacian(const MeshTopology& mesh, double edge_nN_s_per_um,
                                           std::span<const Vector> u, std::span<Vector> out) {
    using Scalar = typename VectorTraits<Vector>::Scalar;
    const auto c = static_cast<Scalar>(edge_nN_s_per_um);
    for (std::size_t i = 0; i < u.size(); ++i) {
        const auto begin = static_cast<std::size_t>(mesh.neighbour_begin[i]);
        const auto end = static_cast<std::size_t>(mesh.neighbour_begin[i + 1]);
        Vector sum = static_cast<Scalar>(end - begin) * u[i];
        for (std::size_t k = begin; k < end; ++k)
            sum -= u[static_cast<std::size_t>(mesh.neighbours[k])];
        out[i] += c * sum;
    }
}

}  // namespace

double edge_friction_nN_s_per_um(double eta_kPa_s, double thickness_um) {
    return eta_kPa_s * thickness_um / std::sqrt(3.0);
}

void add_cortex_friction(const MeshTopology& mesh, double edge_nN_s_per_um, std::span<const Vec3> u,
                         std::span<Vec3> out) {
    add_laplacian(mesh, edge_nN_s_per_um, u, out);
}

void add_cortex_friction(const MeshTopology& mesh, double edge_nN_s_per_um,
                         std::span<const Lanes> u, std::span<Lanes> out) {
    add_laplacian(mesh, edge_nN_s_per_um, u, out);
}

}  // namespace spheroscope
