#pragma once

#include "engine/measures/measure_input.hpp"

// The functions of the table of fields (fields.cpp); each fills one value per node, triangle or
// cell.
namespace spheroscope {

void compute_gamma_eff(const MeasureInput& input, std::span<float> out);    // nodes, eqn (2)
void compute_gamma_total(const MeasureInput& input, std::span<float> out);  // nodes
void compute_sigma_nn(const MeasureInput& input, std::span<float> out);     // triangles, eqn (3)
void compute_shear(const MeasureInput& input, std::span<float> out);        // triangles
void compute_sigma_h(const MeasureInput& input, std::span<float> out);      // cells, eqn (4)
void compute_sigma_radial(const MeasureInput& input, std::span<float> out);
void compute_sigma_tangential(const MeasureInput& input, std::span<float> out);
void compute_anisotropic_max(const MeasureInput& input, std::span<float> out);
void compute_anisotropic_mean(const MeasureInput& input, std::span<float> out);
void compute_pressure(const MeasureInput& input, std::span<float> out);
void compute_stress_xx(const MeasureInput& input, std::span<float> out);
void compute_stress_yy(const MeasureInput& input, std::span<float> out);
void compute_stress_zz(const MeasureInput& input, std::span<float> out);
void compute_stress_xy(const MeasureInput& input, std::span<float> out);
void compute_stress_xz(const MeasureInput& input, std::span<float> out);
void compute_stress_yz(const MeasureInput& input, std::span<float> out);
void compute_neighbours(const MeasureInput& input, std::span<float> out);

}  // namespace spheroscope
