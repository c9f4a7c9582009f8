#include "engine/forces/confining_hull.hpp"

#include "engine/forces/cell_stiffness.hpp"
#include "engine/forces/cell_view.hpp"
#include "engine/forces/nearest_inside.hpp"
#include "engine/forces/parameter_check.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace spheroscope {
namespace {

/// The planes that a cell reaches: a hull has thousands, a cell at the surface some tens of them.
/// Comparisons are such that a coordinate that is not a number rules nothing out.
void find_planes_near(const CellView& view, const Hull& hull,
                      std::vector<const Hull::Plane*>& near) {
    Vec3 middle = Vec3::Zero();
    for (const Vec3& x : view.nodes_um) middle += x;
    middle /= static_cast<double>(view.nodes_um.size());
    double reach2 = 0.0;
    for (const Vec3& x : view.nodes_um) reach2 = std::max(reach2, (x - middle).squaredNorm());
    // a node on the sphere around the middle is within rounding of it
    const double reach_um = (1.0 + 1e-9) * std::sqrt(reach2);
    near.clear();
    for (const Hull::Plane& plane : hull.planes)
        if (!(plane.normal.dot(middle) - plane.offset_um < -reach_um)) near.push_back(&plane);
}

/// Calls visit(node, k a_i in nN/um, x_i, nearest point of the hull) for every node beyond the
/// hull.
template <class Visit>
void for_each_overlap(const Configuration& at, int cell, double k_kPa_per_um, Visit visit) {
    if (at.load.hull == nullptr) return;
    const CellView view(at, cell);
    thread_local std::vector<const Hull::Plane*> near;
    find_planes_near(view, *at.load.hull, near);
    if (near.empty()) return;
    for (int i = 0; i < view.mesh.n_nodes(); ++i) {
        const NearestInside inside = nearest_inside(near, view.x(i));
        // a coordinate that is not a number is not inside
        if (inside.n_across == 0 && view.x(i).allFinite()) continue;
        const double area =
            view.R_um * view.R_um * view.model.unit_node_area[static_cast<std::size_t>(i)];
        visit(i, k_kPa_per_um * area, view.x(i), inside);
    }
}

}  // namespace

ConfiningHull::ConfiningHull(Loc loc, const ConfiningHullParameters& parameters)
    : ForceTerm(std::move(loc)), parameters_(parameters) {
    want_positive(this->loc(), "the hull's stiffness", parameters_.k_kPa_per_um, "kPa/um");
}

void ConfiningHull::add_force(const Configuration& at, int cell, std::span<Vec3> F_nN) const {
    for_each_overlap(at, cell, parameters_.k_kPa_per_um,
                     [&](int i, double k, const Vec3& x_um, const NearestInside& inside) {
                         at_node(F_nN, i) -= k * (x_um - inside.point_um);
                     });
}

std::optional<double> ConfiningHull::energy_fJ(const Configuration& at, int cell) const {
    double sum = 0.0;
    for_each_overlap(at, cell, parameters_.k_kPa_per_um,
                     [&](int, double k, const Vec3& x_um, const NearestInside& inside) {
                         sum += 0.5 * k * (x_um - inside.point_um).squaredNorm();
                     });
    return sum;
}

void ConfiningHull::add_stiffness(const Configuration& at, int cell, CellStiffness& K) const {
    for_each_overlap(at, cell, parameters_.k_kPa_per_um,
                     [&](int i, double k, const Vec3&, const NearestInside& inside) {
                         for (int n = 0; n < inside.n_across; ++n)
                             K.nodes.emplace_back(i, k, inside.across[static_cast<std::size_t>(n)]);
                     });
}

Vec3 ConfiningHull::sum_nN(const Configuration& at) const {
    Vec3 sum = Vec3::Zero();
    for (int cell = 0; cell < at.model.n_cells(); ++cell)
        for_each_overlap(at, cell, parameters_.k_kPa_per_um,
                         [&](int, double k, const Vec3& x_um, const NearestInside& inside) {
                             sum -= k * (x_um - inside.point_um);
                         });
    return sum;
}

}  // namespace spheroscope
