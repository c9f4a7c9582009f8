#include "engine/measures/totals.hpp"

#include "engine/base/index.hpp"
#include "engine/contact/penetration.hpp"
#include "engine/measures/measure_input.hpp"
#include "engine/measures/pair_forces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace spheroscope {
namespace {

constexpr double k_undefined = std::numeric_limits<double>::quiet_NaN();

void add_mesh_quality(const Configuration& at, Totals& totals) {
    const MeshTopology& mesh = *at.model.topology;
    totals.smallest_triangle = std::numeric_limits<double>::infinity();
    totals.n_flipped_triangles = 0;
    totals.n_folds = 0;
    for (int cell = 0; cell < at.model.n_cells(); ++cell) {
        const auto area =
            at.model.cell_triangles(std::span<const double>(at.geometry.area_um2), cell);
        const auto normal =
            at.model.cell_triangles(std::span<const Vec3>(at.geometry.normal), cell);
        const auto centroid =
            at.model.cell_triangles(std::span<const Vec3>(at.geometry.centroid_um), cell);
        double sum_um2 = 0.0, smallest_um2 = std::numeric_limits<double>::infinity();
        for (std::size_t t = 0; t < area.size(); ++t) {
            sum_um2 += area[t];
            smallest_um2 = std::min(smallest_um2, area[t]);
            if (normal[t].dot(centroid[t] - at.geometry.centre_um[idx(cell)]) < 0.0)
                ++totals.n_flipped_triangles;
        }
        totals.smallest_triangle = std::min(
            totals.smallest_triangle, smallest_um2 * static_cast<double>(area.size()) / sum_um2);
        for (const MeshTopology::Edge& e : mesh.edges)
            if (normal[idx(e.left)].dot(normal[idx(e.right)]) < -0.5) ++totals.n_folds;
    }
}

void add_contacts(const MeasureInput& input, Totals& totals) {
    const Configuration& at = input.at;
    double contact_um2 = 0.0, surface_um2 = 0.0;
    int n_links = 0;
    for (const PairForce& pair : pair_forces(at)) {
        contact_um2 += pair.area_um2;
        if (pair.area_um2 > input.touching_area_um2) ++n_links;
    }
    for (const double area_um2 : at.geometry.area_um2) surface_um2 += area_um2;
    totals.contact_area_um2 = contact_um2;
    totals.contact_fraction = 2.0 * contact_um2 / surface_um2;
    totals.coordination_Z = 2.0 * n_links / at.model.n_cells();
}

/// Core and rim (paper: core cells lie two mean radii below the surface of the equivalent sphere).
void add_stresses(const MeasureInput& input, Totals& totals) {
    const Geometry& geometry = input.at.geometry;
    double volume = 0.0, radius_sum = 0.0, virial = 0.0, virial_size = 0.0;
    Vec3 centre = Vec3::Zero();
    for (std::size_t cell = 0; cell < geometry.volume_um3.size(); ++cell) {
        const double sigma_h = input.cell_stress_kPa[cell].trace() / 3.0;
        volume += geometry.volume_um3[cell];
        centre += geometry.volume_um3[cell] * geometry.centre_um[cell];
        radius_sum += input.at.model.radius_um[cell];
        virial += geometry.volume_um3[cell] * sigma_h;
        virial_size += geometry.volume_um3[cell] * std::abs(sigma_h);
    }
    centre /= volume;
    totals.virial_defect = virial_size > 0.0 ? std::abs(virial) / virial_size : k_undefined;
    totals.sigma_h_mean_kPa = virial / volume;
    totals.sigma_h_size_kPa = virial_size / volume;
    totals.R_th_um = std::cbrt(3.0 * volume / (4.0 * std::numbers::pi));
    const double core_um =
        totals.R_th_um - 2.0 * radius_sum / static_cast<double>(geometry.volume_um3.size());
    double core = 0.0, rim = 0.0, core_virial = 0.0, core_volume = 0.0;
    int n_core = 0, n_rim = 0;
    for (std::size_t cell = 0; cell < geometry.volume_um3.size(); ++cell) {
        const double sigma_h = input.cell_stress_kPa[cell].trace() / 3.0;
        const bool is_core = (geometry.centre_um[cell] - centre).norm() < core_um;
        (is_core ? core : rim) += sigma_h;
        ++(is_core ? n_core : n_rim);
        if (is_core) {
            core_virial += geometry.volume_um3[cell] * sigma_h;
            core_volume += geometry.volume_um3[cell];
        }
    }
    totals.n_core_cells = n_core;
    totals.sigma_h_core_kPa = n_core > 0 ? core / n_core : k_undefined;
    totals.sigma_h_core_by_volume_kPa = n_core > 0 ? core_virial / core_volume : k_undefined;
    totals.sigma_h_rim_kPa = n_rim > 0 ? rim / n_rim : k_undefined;
    // Fewer than three core cells are no plateau.
    const double scaled = n_core >= 3 ? totals.sigma_h_core_kPa * totals.R_th_um : k_undefined;
    totals.eps_YL_omega =
        input.omega_nN_per_um > 0.0 ? 1.0 + scaled / (2.0 * input.omega_nN_per_um) : k_undefined;
    totals.eps_YL_W = input.W_nN_per_um > 0.0 ? 1.0 + scaled / input.W_nN_per_um : k_undefined;
}

void add_speeds(const MeasureInput& input, Totals& totals) {
    const auto& gradient = input.at.geometry.volume_gradient_um2;  // along the node's normal
    double normal2 = 0.0, tangential2_max = 0.0;
    for (std::size_t i = 0; i < input.v_um_per_s.size(); ++i) {
        const Vec3& v = input.v_um_per_s[i];
        const double along = v.dot(gradient[i]) / gradient[i].norm();
        normal2 += along * along;
        tangential2_max = std::max(tangential2_max, v.squaredNorm() - along * along);
    }
    totals.normal_speed_rms_um_per_s =
        std::sqrt(normal2 / static_cast<double>(input.v_um_per_s.size()));
    totals.tangential_speed_max_um_per_s = std::sqrt(tangential2_max);
    totals.cell_speed_max_um_per_s = 0.0;
    for (int cell = 0; cell < input.at.model.n_cells(); ++cell) {
        Vec3 sum = Vec3::Zero();
        for (const Vec3& v : input.at.model.cell_nodes(input.v_um_per_s, cell)) sum += v;
        totals.cell_speed_max_um_per_s =
            std::max(totals.cell_speed_max_um_per_s, sum.norm() / input.at.model.n_nodes());
    }
}

}  // namespace

Totals compute_totals(const MeasureInput& input) {
    Totals totals{};
    for (const TotalsRow& row : all_totals())
        if (const auto* real = std::get_if<double Totals::*>(&row.member))
            totals.** real = k_undefined;
    const Configuration& at = input.at;
    add_mesh_quality(at, totals);
    if (!input.cell_stress_kPa.empty()) {
        add_contacts(input, totals);
        add_stresses(input, totals);
    }
    if (!input.pressure_kPa.empty()) {
        totals.mean_pressure_kPa = 0.0;
        for (const double pressure : input.pressure_kPa)
            totals.mean_pressure_kPa += pressure / at.model.n_cells();
    }
    totals.volume_error = 0.0;
    for (std::size_t cell = 0; cell < at.geometry.volume_um3.size(); ++cell)
        totals.volume_error = std::max(
            totals.volume_error,
            std::abs(at.geometry.volume_um3[cell] / at.model.target_volume_um3[cell] - 1.0));
    add_speeds(input, totals);
    return totals;
}

double compute_deepest_node_um(const Configuration& at, Workers& workers) {
    const auto found = deepest_penetration(at.model, at.x_um, 0.0, workers);
    return found ? found->depth_um : 0.0;
}

std::span<const TotalsRow> all_totals() {
    static const std::array rows{
        TotalsRow{"contact_area", "um^2", "sum of the contact areas, each pair of triangles once",
                  &Totals::contact_area_um2},
        TotalsRow{"contact_fraction", "1", "share of the surface in contact",
                  &Totals::contact_fraction},
        TotalsRow{"coordination_Z", "1", "mean number of touching cells", &Totals::coordination_Z},
        TotalsRow{"sigma_h_core", "kPa", "mean hydrostatic stress of core cells",
                  &Totals::sigma_h_core_kPa},
        TotalsRow{"sigma_h_rim", "kPa", "mean hydrostatic stress of the other cells",
                  &Totals::sigma_h_rim_kPa},
        TotalsRow{"n_core_cells", "1", "cells deeper than two mean radii", &Totals::n_core_cells},
        TotalsRow{"R_th", "um", "radius of the sphere with the volume of all cells",
                  &Totals::R_th_um},
        TotalsRow{"eps_YL_omega", "1", "1 + sigma_h_core R_th / (2 omega), the paper's norm",
                  &Totals::eps_YL_omega},
        TotalsRow{"eps_YL_W", "1", "1 + sigma_h_core R_th / W, from the work of adhesion",
                  &Totals::eps_YL_W},
        TotalsRow{"sigma_h_core_by_volume", "kPa", "the same, weighted by volume",
                  &Totals::sigma_h_core_by_volume_kPa},
        TotalsRow{"sigma_h_size", "kPa", "volume-weighted mean of |sigma_h|",
                  &Totals::sigma_h_size_kPa},
        TotalsRow{"sigma_h_mean", "kPa", "volume-weighted mean hydrostatic stress; 0 at rest",
                  &Totals::sigma_h_mean_kPa},
        TotalsRow{"virial_defect", "1", "|sum V sigma_h| / sum V |sigma_h|; 0 at rest",
                  &Totals::virial_defect},
        TotalsRow{"virial_identity", "1",
                  "RMS of sigma_h minus its evaluation from inside, over RMS sigma_h",
                  &Totals::virial_identity},
        TotalsRow{"mean_pressure", "kPa", "mean pressure of the cytosol",
                  &Totals::mean_pressure_kPa},
        TotalsRow{"volume_error", "1", "largest |V - V*| / V*", &Totals::volume_error},
        TotalsRow{"smallest_triangle", "1", "smallest triangle over the mean of its cell",
                  &Totals::smallest_triangle},
        TotalsRow{"n_flipped_triangles", "1", "triangles that face their cell's centre",
                  &Totals::n_flipped_triangles},
        TotalsRow{"n_folds", "1", "edges whose triangles turn by more than 120 degrees",
                  &Totals::n_folds},
        TotalsRow{"normal_speed_rms", "um/s", "RMS of the nodes' speed along their normals",
                  &Totals::normal_speed_rms_um_per_s},
        TotalsRow{"tangential_speed_max", "um/s", "largest speed of a node along the surface",
                  &Totals::tangential_speed_max_um_per_s},
        TotalsRow{"cell_speed_max", "um/s", "largest speed of a cell, the mean of its nodes",
                  &Totals::cell_speed_max_um_per_s},
        TotalsRow{"energy", "fJ", "stored energy", &Totals::energy_fJ},
        TotalsRow{"dissipation", "nN um/s", "v . Gamma v", &Totals::dissipation_nN_um_per_s},
        TotalsRow{
            "power_residual", "1",
            "(change of energy + dissipation - driving work) / dissipation since the last output",
            &Totals::power_residual},
        TotalsRow{"probe_way", "um", "way of the probe since the start of the loading",
                  &Totals::probe_way_um},
        TotalsRow{"probe_force", "nN", "force of the probe on the cells, along its way",
                  &Totals::probe_force_nN},
        TotalsRow{"hull_force", "nN", "force of the hull on the cells, against the probe's way",
                  &Totals::hull_force_nN},
        TotalsRow{"load_imbalance", "1", "sum of all forces on the cells over the probe's force",
                  &Totals::load_imbalance},
        TotalsRow{"deepest_node", "um",
                  "largest depth of a node inside another cell; only where [expect] asks for it",
                  &Totals::deepest_node_um},
    };
    return rows;
}

const TotalsRow* find_total(std::string_view name) {
    for (const TotalsRow& row : all_totals())
        if (row.name == name) return &row;
    return nullptr;
}

double value_of(const TotalsRow& row, const Totals& totals) {
    return std::visit([&](auto member) { return static_cast<double>(totals.*member); }, row.member);
}

}  // namespace spheroscope
