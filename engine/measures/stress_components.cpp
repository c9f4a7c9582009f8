#include "engine/measures/field_functions.hpp"

namespace spheroscope {
namespace {

template <int row, int column> void fill(const MeasureInput& input, std::span<float> out) {
    for (std::size_t cell = 0; cell < out.size(); ++cell)
        out[cell] = static_cast<float>(input.cell_stress_kPa[cell](row, column));
}

}  // namespace

void compute_stress_xx(const MeasureInput& input, std::span<float> out) { fill<0, 0>(input, out); }
void compute_stress_yy(const MeasureInput& input, std::span<float> out) { fill<1, 1>(input, out); }
void compute_stress_zz(const MeasureInput& input, std::span<float> out) { fill<2, 2>(input, out); }
void compute_stress_xy(const MeasureInput& input, std::span<float> out) { fill<0, 1>(input, out); }
void compute_stress_xz(const MeasureInput& input, std::span<float> out) { fill<0, 2>(input, out); }
void compute_stress_yz(const MeasureInput& input, std::span<float> out) { fill<1, 2>(input, out); }

}  // namespace spheroscope
