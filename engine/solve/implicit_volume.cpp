#include "engine/solve/implicit_volume.hpp"

#include "engine/base/index.hpp"

#include <algorithm>

namespace spheroscope {
namespace {

/// Ten thousand times the pressure of a cell (2 gamma/R = 0.1 kPa): a change of it by itself leaves
/// a strain of 1e-4 for one step. Larger ones make the right-hand side, of which the linear
/// tolerance is a fraction, a multiple of the forces.
constexpr double k_exact_modulus_kPa = 1e3;
}  // namespace

void ImplicitVolume::set_up(const System& system, double h_s, bool freeze_integral) {
    const CytosolPressure* cytosol = system.parts().cytosol;
    if (cytosol == nullptr) return;
    h_s_ = h_s;
    const double gain_kPa_per_s = cytosol->K_kPa() / cytosol->T_I_s();
    const double K = cytosol->is_exact() ? 0.0 : cytosol->K_kPa();
    integral_moves_ = cytosol->is_exact() || !freeze_integral;
    integral_kPa_ = cytosol->is_exact() ? k_exact_modulus_kPa
                    : freeze_integral   ? 0.0
                                        : gain_kPa_per_s * h_s;
    exact_step_s_ = cytosol->is_exact() ? k_exact_modulus_kPa / gain_kPa_per_s : 0.0;
    const std::vector<double>& target_um3 = system.model().target_volume_um3;
    coefficient_.resize(target_um3.size());
    for (std::size_t cell = 0; cell < target_um3.size(); ++cell)
        coefficient_[cell] =
            (K * h_s + integral_kPa_ * h_s + K * cytosol->T_d_s()) / target_um3[cell];
}

void ImplicitVolume::add_pressure(const System& system, std::span<const double> rate,
                                  std::span<Vec3> b) const {
    if (!integral_moves_ || integral_kPa_ == 0.0) return;
    const Model& model = system.model();
    for (int cell = 0; cell < model.n_cells(); ++cell) {
        const double pressure_kPa = -integral_kPa_ * rate[idx(cell)];
        const std::span<const Vec3> S =
            model.cell_nodes(std::span<const Vec3>(system.geometry().volume_gradient_um2), cell);
        const std::span<Vec3> b_cell = model.cell_nodes(b, cell);
        for (std::size_t i = 0; i < S.size(); ++i) b_cell[i] += pressure_kPa * S[i];
    }
}

void ImplicitVolume::add_motion(const System& system, std::span<const Vec3> k_um_per_s,
                                std::span<double> rate) const {
    if (!integral_moves_) return;
    const Model& model = system.model();
    for (int cell = 0; cell < model.n_cells(); ++cell) {
        const std::span<const Vec3> S =
            model.cell_nodes(std::span<const Vec3>(system.geometry().volume_gradient_um2), cell);
        const std::span<const Vec3> k = model.cell_nodes(k_um_per_s, cell);
        double volume_rate = 0.0;
        for (std::size_t i = 0; i < S.size(); ++i) volume_rate += S[i].dot(k[i]);
        rate[idx(cell)] += h_s_ * volume_rate / model.target_volume_um3[idx(cell)];
    }
}

void volume_strains(const System& system, std::span<double> strain) {
    std::fill(strain.begin(), strain.end(), 0.0);
    if (system.parts().cytosol == nullptr) return;
    const Configuration at = system.configuration();
    for (int cell = 0; cell < system.model().n_cells(); ++cell)
        strain[idx(cell)] = system.parts().cytosol->volume_strain(at, cell);
}

}  // namespace spheroscope
