#include "engine/statistics/cell_stress.hpp"

#include "engine/base/index.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace spheroscope::statistics {
namespace {

/// The touching triangles of one cell.
struct Touching {
    std::vector<double> normal_kPa, shear_kPa, weight;
};

Touching touching_of(const Aggregate& aggregate, int cell, Weighting weighting) {
    Touching touching;
    const std::size_t n = idx(aggregate.topology->n_triangles());
    for (std::size_t t = idx(cell) * n; t < (idx(cell) + 1) * n; ++t) {
        if (std::isnan(aggregate.sigma_nn_kPa[t])) continue;
        touching.normal_kPa.push_back(aggregate.sigma_nn_kPa[t]);
        touching.shear_kPa.push_back(aggregate.shear_kPa[t]);
        touching.weight.push_back(weighting == Weighting::area ? aggregate.triangle_area_um2[t]
                                                               : 1.0);
    }
    return touching;
}

double weighted_mean(std::span<const double> values, std::span<const double> weights) {
    double sum = 0.0, weight = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        sum += weights[i] * values[i];
        weight += weights[i];
    }
    return sum / weight;
}

double weighted_deviation(std::span<const double> values, std::span<const double> weights) {
    const double mean = weighted_mean(values, weights);
    std::vector<double> squares;
    for (const double value : values) squares.push_back((value - mean) * (value - mean));
    return std::sqrt(weighted_mean(squares, weights));
}

}  // namespace

std::span<const CellStressRow> all_cell_stresses() {
    static constexpr std::array<CellStressRow, 4> rows{{
        {"mean_normal_stress", "mean normal stress", &CellStress::mean_normal},
        {"mean_shear_stress", "mean shear stress", &CellStress::mean_shear},
        {"max_anisotropic_stress", "max. anisotropic stress", &CellStress::anisotropic_max},
        {"mean_anisotropic_stress", "mean anisotropic stress", &CellStress::anisotropic_mean},
    }};
    return rows;
}

std::vector<CellStress> stress_of_cells(const Aggregate& aggregate, Weighting weighting) {
    constexpr double undefined = std::numeric_limits<double>::quiet_NaN();
    std::vector<CellStress> cells;
    for (int cell = 0; cell < aggregate.n_cells(); ++cell) {
        const Touching touching = touching_of(aggregate, cell, weighting);
        if (touching.weight.empty()) {
            cells.push_back({undefined, undefined, undefined, undefined});
            continue;
        }
        CellStress stress{};
        stress.mean_normal = weighted_mean(touching.normal_kPa, touching.weight);
        stress.mean_shear = weighted_mean(touching.shear_kPa, touching.weight);
        if (weighting == Weighting::equal) {  // the fields of engine/measures
            stress.anisotropic_max = aggregate.anisotropic_max_kPa[idx(cell)];
            stress.anisotropic_mean = aggregate.anisotropic_mean_kPa[idx(cell)];
        } else {
            stress.anisotropic_max = weighted_quantile(touching.normal_kPa, touching.weight, 0.95) -
                                     weighted_quantile(touching.normal_kPa, touching.weight, 0.05);
            stress.anisotropic_mean = weighted_deviation(touching.normal_kPa, touching.weight);
        }
        cells.push_back(stress);
    }
    return cells;
}

double weighted_quantile(std::span<const double> values, std::span<const double> weights,
                         double q) {
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
    std::vector<double> place{0.0};  // of the ordered values, not yet scaled
    for (std::size_t k = 1; k < order.size(); ++k)
        place.push_back(place.back() + 0.5 * (weights[order[k - 1]] + weights[order[k]]));
    const double wanted = q * place.back();
    std::size_t k = 0;
    while (k + 2 < place.size() && place[k + 1] < wanted) ++k;
    if (order.size() == 1) return values[order[0]];
    const double share = (wanted - place[k]) / (place[k + 1] - place[k]);
    return values[order[k]] + share * (values[order[k + 1]] - values[order[k]]);
}

}  // namespace spheroscope::statistics
