#include "engine/forces/bending.hpp"

#include "engine/forces/cell_stiffness.hpp"
#include "engine/forces/cell_view.hpp"
#include "engine/forces/hinge_slope.hpp"
#include "engine/forces/parameter_check.hpp"

#include <cmath>
#include <utility>

namespace spheroscope {

double hinge_energy_fJ(double k_fJ, double theta_rad, double rest_rad) {
    const double s = std::sin(0.5 * (theta_rad - rest_rad));
    return 2.0 * k_fJ * s * s;
}

Bending::Bending(Loc loc, const BendingParameters& p)
    : ForceTerm(std::move(loc)), k_fJ_(k_bend_fJ(p.E_kPa, p.thickness_um, p.poisson, p.factor)) {
    want_positive(this->loc(), "cortex.bending.E", p.E_kPa, "kPa");
    want_positive(this->loc(), "cortex.thickness", p.thickness_um, "um");
    want_positive(this->loc(), "cortex.bending.factor", p.factor, "");
    want_between(this->loc(), "cortex.bending.poisson", p.poisson, -1.0, 1.0, "");
}

void Bending::add_force(const Configuration& at, int cell, std::span<Vec3> F_nN) const {
    const CellView view(at, cell);
    for (std::size_t n = 0; n < view.mesh.edges.size(); ++n) {
        const MeshTopology::Edge& e = view.mesh.edges[n];
        const Hinge hinge(view.x(e.i), view.x(e.j), view.x(e.a), view.x(e.b));
        const double moment =  // dU/dtheta = k sin(theta - theta*), eqn (9)
            k_fJ_ *
            hinge.sine_of_turn(view.model.rest_hinge_cosine[n], view.model.rest_hinge_sine[n]);
        const std::array<Vec3, 4> g = hinge.slope.gradient();
        at_node(F_nN, e.i) -= moment * g[0];
        at_node(F_nN, e.j) -= moment * g[1];
        at_node(F_nN, e.a) -= moment * g[2];
        at_node(F_nN, e.b) -= moment * g[3];
    }
}

std::optional<double> Bending::energy_fJ(const Configuration& at, int cell) const {
    const CellView view(at, cell);
    double sum = 0.0;
    for (std::size_t n = 0; n < view.mesh.edges.size(); ++n) {
        const MeshTopology::Edge& e = view.mesh.edges[n];
        sum +=
            hinge_energy_fJ(k_fJ_, hinge_angle(view.x(e.i), view.x(e.j), view.x(e.a), view.x(e.b)),
                            view.model.rest_hinge_angle_rad[n]);
    }
    return sum;
}

void Bending::add_stiffness(const Configuration& at, int cell, CellStiffness& K) const {
    const CellView view(at, cell);
    for (std::size_t n = 0; n < view.mesh.edges.size(); ++n) {
        const MeshTopology::Edge& e = view.mesh.edges[n];
        const Hinge hinge(view.x(e.i), view.x(e.j), view.x(e.a), view.x(e.b));
        const double curvature =  // d2U/dtheta2
            k_fJ_ *
            hinge.cosine_of_turn(view.model.rest_hinge_cosine[n], view.model.rest_hinge_sine[n]);
        if (curvature > 0.0)
            K.hinges.emplace_back(std::array{e.i, e.j, e.a, e.b}, hinge.slope, curvature);
    }
}

}  // namespace spheroscope
