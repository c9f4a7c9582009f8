#pragma once

#include "engine/base/lanes.hpp"
#include "engine/base/vec3.hpp"
#include "engine/model/mesh_topology.hpp"

#include <span>

namespace spheroscope {

/// Friction of the cortex between neighbouring nodes, nN s/um per edge, eqns (15), (16).
/// paper (16): eta/sqrt(3); here times the thickness t: units, and then the discrete Laplacian of a
/// regular lattice is the surface viscosity eta t.
[[nodiscard]] double edge_friction_nN_s_per_um(double eta_kPa_s, double thickness_um);

/// out += c * Laplacian u of one cell's mesh; u, out [n_nodes]. The weight is the same on all
/// edges, so all cells share this matrix, and it acts on x, y and z alike.
void add_cortex_friction(const MeshTopology& mesh, double edge_nN_s_per_um, std::span<const Vec3> u,
                         std::span<Vec3> out);
void add_cortex_friction(const MeshTopology& mesh, double edge_nN_s_per_um,
                         std::span<const Lanes> u, std::span<Lanes> out);

}  // namespace spheroscope
