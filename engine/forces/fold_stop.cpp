#include "engine/forces/fold_stop.hpp"

#include "engine/forces/bending.hpp"
#include "engine/forces/cell_stiffness.hpp"
#include "engine/forces/cell_view.hpp"
#include "engine/forces/hinge_slope.hpp"
#include "engine/forces/parameter_check.hpp"

#include <cmath>
#include <utility>

namespace spheroscope {
namespace {

/// theta - theta* in [-pi, pi].
double turn_from_rest(double theta, double rest) {
    const double turn = theta - rest;
    if (turn > std::numbers::pi) return turn - 2.0 * std::numbers::pi;
    if (turn < -std::numbers::pi) return turn + 2.0 * std::numbers::pi;
    return turn;
}

/// Calls visit(edge, k in fJ, signed angle beyond the fold angle) for every folded hinge.
template <class Visit>
void for_each_fold(const CellView& view, const FoldStopParameters& p, Visit visit) {
    const std::vector<double>& unit_area = view.model.unit_triangle_area;
    for (std::size_t n = 0; n < view.mesh.edges.size(); ++n) {
        const MeshTopology::Edge& e = view.mesh.edges[n];
        const double theta = hinge_angle(view.x(e.i), view.x(e.j), view.x(e.a), view.x(e.b));
        const double turn = turn_from_rest(theta, view.model.rest_hinge_angle_rad[n]);
        const double excess = std::abs(turn) - p.fold_angle_rad;
        if (excess <= 0.0) continue;
        const double rest_area = view.R_um * view.R_um *
                                 (unit_area[static_cast<std::size_t>(e.left)] +
                                  unit_area[static_cast<std::size_t>(e.right)]);
        visit(e, 2.0 * p.kappa_nN_per_um * rest_area, std::copysign(excess, turn));
    }
}

HingeSlope slope(const CellView& view, const MeshTopology::Edge& e) {
    return hinge_slope(view.x(e.i), view.x(e.j), view.x(e.a), view.x(e.b));
}

}  // namespace

FoldStop::FoldStop(Loc loc, const FoldStopParameters& parameters)
    : ForceTerm(std::move(loc)), parameters_(parameters) {
    want_not_negative(this->loc(), "cortex.regularisation.kappa", parameters_.kappa_nN_per_um,
                      "nN/um");
    want_between(this->loc(), "cortex.regularisation.fold_angle", parameters_.fold_angle_rad, 0.0,
                 std::numbers::pi, "rad");
}

void FoldStop::add_force(const Configuration& at, int cell, std::span<Vec3> F_nN) const {
    const CellView view(at, cell);
    for_each_fold(view, parameters_, [&](const MeshTopology::Edge& e, double k, double excess) {
        const std::array<Vec3, 4> g = slope(view, e).gradient();
        at_node(F_nN, e.i) -= k * excess * g[0];
        at_node(F_nN, e.j) -= k * excess * g[1];
        at_node(F_nN, e.a) -= k * excess * g[2];
        at_node(F_nN, e.b) -= k * excess * g[3];
    });
}

std::optional<double> FoldStop::energy_fJ(const Configuration& at, int cell) const {
    double sum = 0.0;
    for_each_fold(CellView(at, cell), parameters_,
                  [&](const MeshTopology::Edge&, double k, double excess) {
                      sum += 0.5 * k * excess * excess;
                  });
    return sum;
}

void FoldStop::add_stiffness(const Configuration& at, int cell, CellStiffness& K) const {
    const CellView view(at, cell);
    for_each_fold(view, parameters_, [&](const MeshTopology::Edge& e, double k, double) {
        K.hinges.emplace_back(std::array{e.i, e.j, e.a, e.b}, slope(view, e), k);
    });
}

}  // namespace spheroscope
