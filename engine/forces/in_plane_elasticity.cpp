#include "engine/forces/in_plane_elasticity.hpp"

#include "engine/forces/cell_stiffness.hpp"
#include "engine/forces/cell_view.hpp"
#include "engine/forces/parameter_check.hpp"

#include <algorithm>
#include <utility>

namespace spheroscope {
namespace {

/// Calls visit(edge, k, d*) for the spring on every edge of the cell.
template <class Visit>
void for_each_spring(const CellView& cell, const InPlaneElasticityParameters& p, Visit visit) {
    const Model& model = cell.model;
    for (std::size_t n = 0; n < cell.mesh.edges.size(); ++n) {
        const MeshTopology::Edge& e = cell.mesh.edges[n];
        // k from the unit cell's rest shape: the radius cancels.
        const double unit_length = model.unit_edge_length[n];
        const double k = k_spring_nN_per_um(
            p.E_kPa, p.thickness_um, model.unit_triangle_area[static_cast<std::size_t>(e.left)],
            model.unit_triangle_area[static_cast<std::size_t>(e.right)], unit_length);
        visit(e, k, cell.R_um * unit_length);
    }
}

}  // namespace

InPlaneElasticity::InPlaneElasticity(Loc loc, const InPlaneElasticityParameters& parameters)
    : ForceTerm(std::move(loc)), parameters_(parameters) {
    want_positive(this->loc(), "cortex.elastic.E", parameters_.E_kPa, "kPa");
    want_positive(this->loc(), "cortex.thickness", parameters_.thickness_um, "um");
}

void InPlaneElasticity::add_force(const Configuration& at, int cell, std::span<Vec3> F_nN) const {
    const CellView view(at, cell);
    for_each_spring(view, parameters_, [&](const MeshTopology::Edge& e, double k, double rest) {
        const Vec3 f = spring_force_nN(k, rest, view.x(e.i), view.x(e.j));
        at_node(F_nN, e.i) += f;
        at_node(F_nN, e.j) -= f;
    });
}

std::optional<double> InPlaneElasticity::energy_fJ(const Configuration& at, int cell) const {
    const CellView view(at, cell);
    double sum = 0.0;
    for_each_spring(view, parameters_, [&](const MeshTopology::Edge& e, double k, double rest) {
        sum += spring_energy_fJ(k, rest, view.x(e.i), view.x(e.j));
    });
    return sum;
}

void InPlaneElasticity::add_stiffness(const Configuration& at, int cell, CellStiffness& K) const {
    const CellView view(at, cell);
    for_each_spring(view, parameters_, [&](const MeshTopology::Edge& e, double k, double rest) {
        const Vec3 along = view.x(e.j) - view.x(e.i);
        const double d = along.norm();
        const double transverse = std::max(0.0, k * (1.0 - rest / d));
        K.edges.emplace_back(e.i, e.j, transverse, k - transverse, along / d);
    });
}

}  // namespace spheroscope
