#include "engine/forces/active_tension.hpp"

#include "engine/forces/cell_stiffness.hpp"
#include "engine/forces/cell_view.hpp"
#include "engine/forces/parameter_check.hpp"

#include <utility>

namespace spheroscope {

ActiveTension::ActiveTension(Loc loc, const ActiveTensionParameters& parameters)
    : ForceTerm(std::move(loc)), gamma_nN_per_um_(parameters.gamma_nN_per_um) {
    want_not_negative(this->loc(), "cortex.tension.gamma", gamma_nN_per_um_, "nN/um");
}

void ActiveTension::add_force(const Configuration& at, int cell, std::span<Vec3> F_nN) const {
    const CellView view(at, cell);
    for (std::size_t t = 0; t < view.mesh.triangles.size(); ++t) {
        const auto& [i, j, k] = view.mesh.triangles[t];
        const Vec3& n = at.geometry.normal[view.first_triangle + t];
        at_node(F_nN, i) += tension_force_nN(gamma_nN_per_um_, view.x(j), view.x(k), n);
        at_node(F_nN, j) += tension_force_nN(gamma_nN_per_um_, view.x(k), view.x(i), n);
        at_node(F_nN, k) += tension_force_nN(gamma_nN_per_um_, view.x(i), view.x(j), n);
    }
}

std::optional<double> ActiveTension::energy_fJ(const Configuration& at, int cell) const {
    const CellView view(at, cell);
    double area_um2 = 0.0;
    for (std::size_t t = 0; t < view.mesh.triangles.size(); ++t)
        area_um2 += at.geometry.area_um2[view.first_triangle + t];
    return gamma_nN_per_um_ * area_um2;
}

void ActiveTension::add_stiffness(const Configuration& at, int cell, CellStiffness& K) const {
    const CellView view(at, cell);
    for (std::size_t t = 0; t < view.mesh.triangles.size(); ++t) {
        const auto& [i, j, k] = view.mesh.triangles[t];
        const Vec3 ij = view.x(j) - view.x(i), jk = view.x(k) - view.x(j),
                   ki = view.x(i) - view.x(k);
        // gamma/2 times the cotangent of the angle at each corner, cot = (dot of its sides)/2A.
        // That of an obtuse angle is negative, but the sum over the three sides is gamma |sum w_a
        // e_a|^2/4A for normal displacements w_a and sides e_a: never negative.
        const double weight =
            gamma_nN_per_um_ / (4.0 * at.geometry.area_um2[view.first_triangle + t]);
        K.normals.emplace_back(
            std::array{i, j, k},
            std::array{-weight * ij.dot(ki), -weight * ij.dot(jk), -weight * jk.dot(ki)},
            at.geometry.normal[view.first_triangle + t]);
    }
}

}  // namespace spheroscope
