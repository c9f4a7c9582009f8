#include "render/layers/stress_axes.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace spheroscope::render {
namespace {

constexpr double k_thickness_share = 0.07;  // radius of a rod over the mean cell radius
constexpr double k_shortest_share = 0.02;   // shorter rods would be discs
constexpr Rgb k_compression{18, 58, 150}, k_tension{176, 18, 32};

}  // namespace

Rgb StressAxes::rod_colour(double stress_kPa) {
    return stress_kPa < 0.0 ? k_compression : k_tension;
}

double StressAxes::update(const Snapshot& snapshot, const StressComponents& components,
                          std::span<const int> cells) {
    std::vector<PrincipalStress> stress;
    double largest_kPa = 0.0;
    for (const int cell : cells) {
        stress.push_back(principal_stress(snapshot, components, cell));
        largest_kPa = std::max(largest_kPa, stress.back().value_kPa.cwiseAbs().maxCoeff());
    }
    rods_.clear();
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const std::size_t c = 3 * static_cast<std::size_t>(cells[i]);
        const Vec3 centre(double{snapshot.centre_um[c]}, double{snapshot.centre_um[c + 1]},
                          double{snapshot.centre_um[c + 2]});
        for (int k = 0; k < 3; ++k) {
            const double value = stress[i].value_kPa[k];
            if (!(std::abs(value) > k_shortest_share * largest_kPa)) continue;
            const Vec3 half =
                mean_radius_um_ * std::abs(value) / largest_kPa * stress[i].axes.col(k);
            rods_.add_rod(centre - half, centre + half, k_thickness_share * mean_radius_um_,
                          rod_colour(value));
        }
    }
    rods_.finish();
    return largest_kPa;
}

}  // namespace spheroscope::render
