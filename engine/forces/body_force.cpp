#include "engine/forces/body_force.hpp"

#include "engine/forces/cell_view.hpp"
#include "engine/forces/parameter_check.hpp"

#include <utility>

namespace spheroscope {

BodyForce::BodyForce(Loc loc, const BodyForceParameters& parameters)
    : ForceTerm(std::move(loc)), parameters_(parameters) {
    for (int axis = 0; axis < 3; ++axis)
        want_finite(this->loc(), "body_force.force", parameters_.force_nN[axis], "nN");
}

Vec3 BodyForce::on_cell_nN(int cell) const {
    if (!parameters_.opposed || cell == 0) return parameters_.force_nN;
    if (cell == 1) return -parameters_.force_nN;
    return Vec3::Zero();
}

void BodyForce::add_force(const Configuration& at, int cell, std::span<Vec3> F_nN) const {
    const Vec3 per_area = on_cell_nN(cell) / at.model.unit_area;
    for (std::size_t i = 0; i < F_nN.size(); ++i) F_nN[i] += at.model.unit_node_area[i] * per_area;
}

std::optional<double> BodyForce::energy_fJ(const Configuration& at, int cell) const {
    const CellView view(at, cell);
    const Vec3 per_area = on_cell_nN(cell) / at.model.unit_area;
    double sum = 0.0;
    for (std::size_t i = 0; i < view.nodes_um.size(); ++i)
        sum -= at.model.unit_node_area[i] * per_area.dot(view.nodes_um[i]);
    return sum;
}

}  // namespace spheroscope
