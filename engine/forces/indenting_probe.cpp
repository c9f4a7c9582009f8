#include "engine/forces/indenting_probe.hpp"

#include "engine/forces/cell_stiffness.hpp"
#include "engine/forces/cell_view.hpp"
#include "engine/forces/parameter_check.hpp"

#include <utility>

namespace spheroscope {
namespace {

/// Calls visit(node, k a_i in nN/um, overlap in um, outward direction) for every node in the probe.
template <class Visit>
void for_each_overlap(const Configuration& at, int cell, double k_kPa_per_um, Visit visit) {
    const Probe& probe = at.load.probe;
    if (!probe.acts()) return;
    const CellView view(at, cell);
    const Vec3 centre_um = probe.centre_um();
    const double radius2 = probe.radius_um * probe.radius_um;
    for (int i = 0; i < view.mesh.n_nodes(); ++i) {
        const Vec3 from_centre = view.x(i) - centre_um;
        if (from_centre.squaredNorm() >= radius2) continue;
        const double distance_um = from_centre.norm();
        const double area =
            view.R_um * view.R_um * view.model.unit_node_area[static_cast<std::size_t>(i)];
        visit(i, k_kPa_per_um * area, probe.radius_um - distance_um,
              Vec3(from_centre / distance_um));
    }
}

}  // namespace

IndentingProbe::IndentingProbe(Loc loc, const IndentingProbeParameters& parameters)
    : ForceTerm(std::move(loc)), parameters_(parameters) {
    want_positive(this->loc(), "the probe's stiffness", parameters_.k_kPa_per_um, "kPa/um");
}

void IndentingProbe::add_force(const Configuration& at, int cell, std::span<Vec3> F_nN) const {
    for_each_overlap(at, cell, parameters_.k_kPa_per_um,
                     [&](int i, double k, double overlap, const Vec3& outward) {
                         at_node(F_nN, i) += k * overlap * outward;
                     });
}

std::optional<double> IndentingProbe::energy_fJ(const Configuration& at, int cell) const {
    double sum = 0.0;
    for_each_overlap(
        at, cell, parameters_.k_kPa_per_um,
        [&](int, double k, double overlap, const Vec3&) { sum += 0.5 * k * overlap * overlap; });
    return sum;
}

void IndentingProbe::add_stiffness(const Configuration& at, int cell, CellStiffness& K) const {
    for_each_overlap(
        at, cell, parameters_.k_kPa_per_um,
        [&](int i, double k, double, const Vec3& outward) { K.nodes.emplace_back(i, k, outward); });
}

void IndentingProbe::find_touches(const Configuration& at, std::vector<Touch>& touches) const {
    touches.clear();
    const auto n_nodes = static_cast<std::size_t>(at.model.n_nodes());
    for (int cell = 0; cell < at.model.n_cells(); ++cell)
        for_each_overlap(
            at, cell, parameters_.k_kPa_per_um,
            [&](int i, double k, double overlap, const Vec3& outward) {
                touches.push_back(
                    {static_cast<std::size_t>(cell) * n_nodes + static_cast<std::size_t>(i), k,
                     overlap, outward, outward.dot(at.load.probe.direction)});
            });
}

Vec3 IndentingProbe::sum_nN(const Configuration& at) const {
    Vec3 sum = Vec3::Zero();
    for (int cell = 0; cell < at.model.n_cells(); ++cell)
        for_each_overlap(at, cell, parameters_.k_kPa_per_um,
                         [&](int, double k, double overlap, const Vec3& outward) {
                             sum += k * overlap * outward;
                         });
    return sum;
}

}  // namespace spheroscope
