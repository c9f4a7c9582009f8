#include "engine/forces/held_force.hpp"

#include "engine/forces/parameter_check.hpp"

#include <utility>

namespace spheroscope {

HeldForce::HeldForce(Loc loc, std::vector<Vec3> force_nN)
    : ForceTerm(std::move(loc)), force_nN_(std::move(force_nN)) {
    for (const Vec3& force : force_nN_)
        for (int axis = 0; axis < 3; ++axis)
            want_finite(this->loc(), "a held force", force[axis], "nN");
}

void HeldForce::add_force(const Configuration& at, int cell, std::span<Vec3> F_nN) const {
    const auto held = at.model.cell_nodes(std::span<const Vec3>(force_nN_), cell);
    for (std::size_t i = 0; i < F_nN.size(); ++i) F_nN[i] += held[i];
}

std::optional<double> HeldForce::energy_fJ(const Configuration& at, int cell) const {
    const auto held = at.model.cell_nodes(std::span<const Vec3>(force_nN_), cell);
    const auto x = at.model.cell_nodes(at.x_um, cell);
    double sum = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) sum -= held[i].dot(x[i]);
    return sum;
}

}  // namespace spheroscope
