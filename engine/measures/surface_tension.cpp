// Surface tension at a node, Cuvelier et al. 2021, eqn (2):
//   gamma_i^eff = 1/N_i sum_j F_ij . t_ij / (d_ij tan(pi / N_i)),   F . t = k (d - d*)
// paper (2): F . n_ij; here F . t_ij, along the edge: across it a spring has no force. This is the
// elastic part; the active tension gamma comes on top of it.
#include "engine/measures/field_functions.hpp"

#include <cmath>
#include <numbers>

namespace spheroscope {
namespace {

void add_elastic_tension(const MeasureInput& input, double offset, std::span<float> out) {
    const Model& model = input.at.model;
    const MeshTopology& mesh = *model.topology;
    std::vector<double> sum(static_cast<std::size_t>(mesh.n_nodes()));
    for (int cell = 0; cell < model.n_cells(); ++cell) {
        std::fill(sum.begin(), sum.end(), 0.0);
        const std::span<const Vec3> x = model.cell_nodes(input.at.x_um, cell);
        const double R = model.radius_um[static_cast<std::size_t>(cell)];
        for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
            const auto i = static_cast<std::size_t>(mesh.edges[e].i);
            const auto j = static_cast<std::size_t>(mesh.edges[e].j);
            const double d = (x[j] - x[i]).norm();
            const double per_length =
                input.spring_nN_per_um[e] * (d - R * model.unit_edge_length[e]) / d;
            sum[i] += per_length;
            sum[j] += per_length;
        }
        const std::span<float> values = model.cell_nodes(out, cell);
        for (std::size_t i = 0; i < sum.size(); ++i) {
            const int degree = mesh.neighbour_begin[i + 1] - mesh.neighbour_begin[i];
            values[i] = static_cast<float>(offset +
                                           sum[i] / (degree * std::tan(std::numbers::pi / degree)));
        }
    }
}

}  // namespace

void compute_gamma_eff(const MeasureInput& input, std::span<float> out) {
    add_elastic_tension(input, 0.0, out);
}

void compute_gamma_total(const MeasureInput& input, std::span<float> out) {
    if (input.spring_nN_per_um.empty())
        std::fill(out.begin(), out.end(), static_cast<float>(input.gamma_nN_per_um));
    else
        add_elastic_tension(input, input.gamma_nN_per_um, out);
}

}  // namespace spheroscope
