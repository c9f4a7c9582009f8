// Traction of the contacts on each triangle, Cuvelier et al. 2021, eqn (3): sigma_nn = sum_B F_AB .
// n_A / S_A, with the force on A; repulsion pushes a triangle inwards, so tension is positive. The
// rest of the same vector is the shear stress.
#include "engine/measures/field_functions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace spheroscope {
namespace {

struct Traction {
    double normal_kPa = std::numeric_limits<double>::quiet_NaN();
    double shear_kPa = std::numeric_limits<double>::quiet_NaN();
    [[nodiscard]] bool has_contact() const { return !std::isnan(normal_kPa); }
};

/// Tractions of one cell's triangles; NaN without contact.
std::vector<Traction> tractions_of(const MeasureInput& input, int cell) {
    const Model& model = input.at.model;
    const auto n = static_cast<std::size_t>(model.topology->n_triangles());
    std::vector<Vec3> force(n, Vec3::Zero());
    std::vector<char> touched(n, 0);
    for (const Contacts::Side& side : input.at.contacts.sides_of(cell)) {
        const auto& group = input.at.contacts.groups[static_cast<std::size_t>(side.group)];
        for (const ContactPair& pair : input.at.contacts.pairs_of(group)) {
            const auto t = static_cast<std::size_t>(side.is_a ? pair.triangle_a : pair.triangle_b);
            force[t] += (side.is_a ? pair.force_nN() : -pair.force_nN()) * pair.normal;
            touched[t] = 1;
        }
    }
    const std::span<const Vec3> normal =
        model.cell_triangles(std::span<const Vec3>(input.at.geometry.normal), cell);
    const std::span<const double> area =
        model.cell_triangles(std::span<const double>(input.at.geometry.area_um2), cell);
    std::vector<Traction> tractions(n);
    for (std::size_t t = 0; t < n; ++t) {
        if (touched[t] == 0) continue;
        const double along = force[t].dot(normal[t]);
        tractions[t] = {along / area[t], (force[t] - along * normal[t]).norm() / area[t]};
    }
    return tractions;
}

/// sigma_nn of the touching triangles of one cell, ascending.
std::vector<double> sorted_normal_stress(const MeasureInput& input, int cell) {
    std::vector<double> values;
    for (const Traction& traction : tractions_of(input, cell))
        if (traction.has_contact()) values.push_back(traction.normal_kPa);
    std::sort(values.begin(), values.end());
    return values;
}

/// Value below which the share q of a sorted list lies (linear between the order statistics).
double quantile(const std::vector<double>& sorted, double q) {
    const double position = q * static_cast<double>(sorted.size() - 1);
    const auto low = static_cast<std::size_t>(position);
    const std::size_t high = std::min(low + 1, sorted.size() - 1);
    return sorted[low] + (position - static_cast<double>(low)) * (sorted[high] - sorted[low]);
}

template <double Traction::*member>
void compute_traction(const MeasureInput& input, std::span<float> out) {
    for (int cell = 0; cell < input.at.model.n_cells(); ++cell) {
        const std::vector<Traction> tractions = tractions_of(input, cell);
        const std::span<float> values = input.at.model.cell_triangles(out, cell);
        for (std::size_t t = 0; t < tractions.size(); ++t)
            values[t] = static_cast<float>(tractions[t].*member);
    }
}

}  // namespace

void compute_sigma_nn(const MeasureInput& input, std::span<float> out) {
    compute_traction<&Traction::normal_kPa>(input, out);
}

void compute_shear(const MeasureInput& input, std::span<float> out) {
    compute_traction<&Traction::shear_kPa>(input, out);
}

void compute_anisotropic_max(const MeasureInput& input, std::span<float> out) {
    for (int cell = 0; cell < input.at.model.n_cells(); ++cell) {
        const std::vector<double> values = sorted_normal_stress(input, cell);
        out[static_cast<std::size_t>(cell)] =
            values.empty() ? std::numeric_limits<float>::quiet_NaN()
                           : static_cast<float>(quantile(values, 0.95) - quantile(values, 0.05));
    }
}

void compute_anisotropic_mean(const MeasureInput& input, std::span<float> out) {
    for (int cell = 0; cell < input.at.model.n_cells(); ++cell) {
        const std::vector<double> values = sorted_normal_stress(input, cell);
        double mean = 0.0, mean2 = 0.0;
        for (const double value : values) mean += value / static_cast<double>(values.size());
        for (const double value : values)
            mean2 += (value - mean) * (value - mean) / static_cast<double>(values.size());
        out[static_cast<std::size_t>(cell)] = values.empty()
                                                  ? std::numeric_limits<float>::quiet_NaN()
                                                  : static_cast<float>(std::sqrt(mean2));
    }
}

}  // namespace spheroscope
