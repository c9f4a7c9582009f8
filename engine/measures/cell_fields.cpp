#include "engine/measures/field_functions.hpp"
#include "engine/measures/pair_forces.hpp"

#include <limits>

namespace spheroscope {
namespace {

/// Centre of the aggregate: mean of the cell centres, weighted by volume, um.
Vec3 aggregate_centre(const Configuration& at) {
    Vec3 sum = Vec3::Zero();
    double volume = 0.0;
    for (std::size_t cell = 0; cell < at.geometry.volume_um3.size(); ++cell) {
        sum += at.geometry.volume_um3[cell] * at.geometry.centre_um[cell];
        volume += at.geometry.volume_um3[cell];
    }
    return sum / volume;
}

/// r . sigma . r with r from the centre of the aggregate to the cell.
double radial_stress(const MeasureInput& input, std::size_t cell, const Vec3& centre) {
    const Vec3 r = input.at.geometry.centre_um[cell] - centre;
    if (r.squaredNorm() == 0.0) return std::numeric_limits<double>::quiet_NaN();
    const Vec3 direction = r.normalized();
    return direction.dot(input.cell_stress_kPa[cell] * direction);
}

}  // namespace

void compute_sigma_h(const MeasureInput& input, std::span<float> out) {
    for (std::size_t cell = 0; cell < out.size(); ++cell)
        out[cell] = static_cast<float>(input.cell_stress_kPa[cell].trace() / 3.0);
}

void compute_sigma_radial(const MeasureInput& input, std::span<float> out) {
    const Vec3 centre = aggregate_centre(input.at);
    for (std::size_t cell = 0; cell < out.size(); ++cell)
        out[cell] = static_cast<float>(radial_stress(input, cell, centre));
}

void compute_sigma_tangential(const MeasureInput& input, std::span<float> out) {
    const Vec3 centre = aggregate_centre(input.at);
    for (std::size_t cell = 0; cell < out.size(); ++cell)
        out[cell] = static_cast<float>(
            0.5 * (input.cell_stress_kPa[cell].trace() - radial_stress(input, cell, centre)));
}

void compute_pressure(const MeasureInput& input, std::span<float> out) {
    for (std::size_t cell = 0; cell < out.size(); ++cell)
        out[cell] = static_cast<float>(input.pressure_kPa[cell]);
}

void compute_neighbours(const MeasureInput& input, std::span<float> out) {
    std::fill(out.begin(), out.end(), 0.0F);
    for (const PairForce& pair : pair_forces(input.at)) {
        if (pair.area_um2 <= input.touching_area_um2) continue;
        out[static_cast<std::size_t>(pair.cell_a)] += 1.0F;
        out[static_cast<std::size_t>(pair.cell_b)] += 1.0F;
    }
}

}  // namespace spheroscope
