#include "engine/forces/indenting_probe.hpp"

#include "engine/forces/cell_stiffness.hpp"
#include "engine/forces/cell_view.hpp"
#include "engine/forces/parameter_check.hpp"

#include <cmath>
#include <numbers>
#include <utility>

namespace spheroscope {
namespace {

/// One node of a cell in the probe.
struct Node {
    int i;
    double area_um2, overlap_um;
    Vec3 outward;
    double force_nN, k_nN_per_um;
};

void find_nodes(const Configuration& at, int cell, std::vector<Node>& nodes) {
    nodes.clear();
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
        nodes.push_back({i, area, probe.radius_um - distance_um, from_centre / distance_um, 0, 0});
    }
}

/// Hertz's law between the probe and one cell, at its present overlap.
struct Hertz {
    double k_kPa_per_um = 0.0;  ///< pressure of a node over its overlap
    double energy_fJ = 0.0;

    Hertz(const std::vector<Node>& nodes, double modulus_kPa, double probe_radius_um,
          double cell_radius_um) {
        double moment_um4 = 0.0;  // pi R d^3 / 3 where two spheres overlap by d
        for (const Node& node : nodes)
            moment_um4 += 0.5 * node.area_um2 * node.overlap_um * node.overlap_um;
        if (!(moment_um4 > 0.0)) return;
        const double R_um = 1.0 / (1.0 / probe_radius_um + 1.0 / cell_radius_um);
        const double d_um = std::cbrt(3.0 * moment_um4 / (std::numbers::pi * R_um));
        k_kPa_per_um = 4.0 / (3.0 * std::numbers::pi) * modulus_kPa / std::sqrt(R_um * d_um);
        energy_fJ = 8.0 / 15.0 * modulus_kPa * std::sqrt(R_um) * std::pow(d_um, 2.5);
    }
};

/// Calls visit(node) for every node of the cell that the probe touches.
template <class Visit> void for_each_touch(const Configuration& at, int cell,
                                           const IndentingProbeParameters& parameters,
                                           Visit visit) {
    thread_local std::vector<Node> nodes;
    find_nodes(at, cell, nodes);
    if (nodes.empty()) return;
    double k_kPa_per_um = parameters.k_kPa_per_um;
    if (parameters.hertz_modulus_kPa > 0.0) {
        // Its k falls as the overlap grows. That is left out of the slope: it couples all nodes of
        // the cell, and without it the slope is larger than the exact one by up to a third.
        const Hertz law(nodes, parameters.hertz_modulus_kPa, at.load.probe.radius_um,
                        at.model.radius_um[static_cast<std::size_t>(cell)]);
        k_kPa_per_um = law.k_kPa_per_um;
    }
    for (Node& node : nodes) {
        node.k_nN_per_um = k_kPa_per_um * node.area_um2;
        node.force_nN = node.k_nN_per_um * node.overlap_um;
        visit(node);
    }
}

}  // namespace

IndentingProbe::IndentingProbe(Loc loc, const IndentingProbeParameters& parameters)
    : ForceTerm(std::move(loc)), parameters_(parameters) {
    want_positive(this->loc(), "the probe's stiffness", parameters_.k_kPa_per_um, "kPa/um");
}

void IndentingProbe::add_force(const Configuration& at, int cell, std::span<Vec3> F_nN) const {
    for_each_touch(at, cell, parameters_, [&](const Node& node) {
        at_node(F_nN, node.i) += node.force_nN * node.outward;
    });
}

std::optional<double> IndentingProbe::energy_fJ(const Configuration& at, int cell) const {
    if (parameters_.hertz_modulus_kPa > 0.0) {
        std::vector<Node> nodes;
        find_nodes(at, cell, nodes);
        return Hertz(nodes, parameters_.hertz_modulus_kPa, at.load.probe.radius_um,
                     at.model.radius_um[static_cast<std::size_t>(cell)])
            .energy_fJ;
    }
    double sum = 0.0;
    for_each_touch(at, cell, parameters_,
                   [&](const Node& node) { sum += 0.5 * node.force_nN * node.overlap_um; });
    return sum;
}

void IndentingProbe::add_stiffness(const Configuration& at, int cell, CellStiffness& K) const {
    for_each_touch(at, cell, parameters_, [&](const Node& node) {
        K.nodes.emplace_back(node.i, node.k_nN_per_um, node.outward);
    });
}

void IndentingProbe::find_touches(const Configuration& at, std::vector<Touch>& touches) const {
    touches.clear();
    const auto n_nodes = static_cast<std::size_t>(at.model.n_nodes());
    for (int cell = 0; cell < at.model.n_cells(); ++cell)
        for_each_touch(at, cell, parameters_, [&](const Node& node) {
            touches.push_back(
                {static_cast<std::size_t>(cell) * n_nodes + static_cast<std::size_t>(node.i),
                 node.k_nN_per_um, node.force_nN, node.outward,
                 node.outward.dot(at.load.probe.direction)});
        });
}

Vec3 IndentingProbe::sum_nN(const Configuration& at) const {
    Vec3 sum = Vec3::Zero();
    for (int cell = 0; cell < at.model.n_cells(); ++cell)
        for_each_touch(at, cell, parameters_,
                       [&](const Node& node) { sum += node.force_nN * node.outward; });
    return sum;
}

}  // namespace spheroscope
