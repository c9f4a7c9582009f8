#include "engine/statistics/aggregate.hpp"

#include "engine/base/index.hpp"
#include "engine/forces/in_plane_elasticity.hpp"
#include "engine/measures/field_functions.hpp"

#include <cmath>
#include <numbers>

namespace spheroscope::statistics {
namespace {

using Compute = void (*)(const MeasureInput&, std::span<float>);

std::vector<double> field_of(const MeasureInput& input, Compute compute, std::size_t n) {
    std::vector<float> values(n);
    compute(input, values);
    return {values.begin(), values.end()};
}

std::vector<double> spring_constants_nN_per_um(const Model& model, const scene::Cortex& cortex) {
    std::vector<double> k;
    if (!cortex.elastic) return k;
    for (std::size_t e = 0; e < model.topology->edges.size(); ++e) {
        const MeshTopology::Edge& edge = model.topology->edges[e];
        k.push_back(k_spring_nN_per_um(
            cortex.elastic->E_kPa, cortex.thickness_um, model.unit_triangle_area[idx(edge.left)],
            model.unit_triangle_area[idx(edge.right)], model.unit_edge_length[e]));
    }
    return k;
}

}  // namespace

double Aggregate::distance_um(int cell) const { return (centre_um[idx(cell)] - middle_um).norm(); }

void finish_aggregate(Aggregate& aggregate) {
    double volume = 0.0, radius = 0.0;
    Vec3 middle = Vec3::Zero();
    for (std::size_t c = 0; c < aggregate.centre_um.size(); ++c) {
        volume += aggregate.volume_um3[c];
        radius += aggregate.radius_um[c];
        middle += aggregate.volume_um3[c] * aggregate.centre_um[c];
    }
    aggregate.middle_um = middle / volume;
    aggregate.R_th_um = std::cbrt(3.0 * volume / (4.0 * std::numbers::pi));
    aggregate.mean_radius_um = radius / static_cast<double>(aggregate.centre_um.size());
}

Aggregate aggregate_of(const inspect::FrameSystem& frame) {
    const Configuration at = frame.system().configuration();
    const Model& model = at.model;
    const std::vector<Mat3> stress = cell_stress_tensors(at);
    const std::vector<double> springs = spring_constants_nN_per_um(model, frame.scene().cortex);
    const MeasureInput input{.at = at,
                             .v_um_per_s = {},
                             .spring_nN_per_um = springs,
                             .pressure_kPa = {},
                             .cell_stress_kPa = stress,
                             .touching_area_um2 = frame.scene().measures.touching_area_um2};
    Aggregate aggregate;
    aggregate.topology = model.topology;
    aggregate.x_um.assign(at.x_um.begin(), at.x_um.end());
    aggregate.centre_um = at.geometry.centre_um;
    aggregate.radius_um = model.radius_um;
    aggregate.volume_um3 = at.geometry.volume_um3;
    aggregate.triangle_area_um2 = at.geometry.area_um2;
    const std::size_t n_cells = model.radius_um.size(), n_triangles = model.n_all_triangles();
    for (const Mat3& tensor : stress) aggregate.sigma_h_kPa.push_back(tensor.trace() / 3.0);
    aggregate.anisotropic_max_kPa = field_of(input, compute_anisotropic_max, n_cells);
    aggregate.anisotropic_mean_kPa = field_of(input, compute_anisotropic_mean, n_cells);
    aggregate.sigma_nn_kPa = field_of(input, compute_sigma_nn, n_triangles);
    aggregate.shear_kPa = field_of(input, compute_shear, n_triangles);
    if (!springs.empty())
        aggregate.gamma_eff_nN_per_um = field_of(input, compute_gamma_eff, model.n_all_nodes());
    aggregate.pairs = pair_forces(at);
    aggregate.touching_area_um2 = input.touching_area_um2;
    finish_aggregate(aggregate);
    return aggregate;
}

}  // namespace spheroscope::statistics
