#include "engine/forces/cytosol_pressure.hpp"

#include "engine/forces/parameter_check.hpp"

#include <cmath>
#include <utility>

namespace spheroscope {

CytosolPressure::CytosolPressure(Loc loc, const CytosolPressureParameters& parameters)
    : ForceTerm(std::move(loc)), parameters_(parameters) {
    want_not_negative(this->loc(), "cytosol.K", parameters_.K_kPa, "kPa");
    if (!std::isinf(parameters_.T_I_s))
        want_positive(this->loc(), "cytosol.T_I", parameters_.T_I_s, "s");
    want_not_negative(this->loc(), "cytosol.T_d", parameters_.T_d_s, "s");
    want_finite(this->loc(), "cytosol.extra_pressure", parameters_.extra_pressure_kPa, "kPa");
    want_not_negative(this->loc(), "cortex.tension.gamma", parameters_.gamma_nN_per_um, "nN/um");
}

double CytosolPressure::volume_strain(const Configuration& at, int cell) const {
    const auto c = static_cast<std::size_t>(cell);
    const double target = at.model.target_volume_um3[c];
    return (at.geometry.volume_um3[c] - target) / target;
}

double CytosolPressure::offset_kPa(const Model& model, int cell) const {
    const double R = model.radius_um[static_cast<std::size_t>(cell)];
    return offset_pressure_kPa(parameters_.gamma_nN_per_um, R * R * model.unit_area,
                               model.rest_volume_um3(cell));
}

double CytosolPressure::pressure_at_target_kPa(const Configuration& at, int cell) const {
    // K/T_I is 0 for the infinite T_I of a proportional controller.
    return offset_kPa(at.model, cell) + parameters_.extra_pressure_kPa -
           parameters_.K_kPa / parameters_.T_I_s *
               at.volume_integral_s[static_cast<std::size_t>(cell)];
}

double CytosolPressure::pressure_kPa(const Configuration& at, int cell) const {
    const double proportional_kPa =
        parameters_.is_exact ? 0.0 : parameters_.K_kPa * volume_strain(at, cell);
    return pressure_at_target_kPa(at, cell) - proportional_kPa;
}

void CytosolPressure::add_force(const Configuration& at, int cell, std::span<Vec3> F_nN) const {
    const double P = pressure_kPa(at, cell);
    const std::span<const Vec3> S =
        at.model.cell_nodes(std::span<const Vec3>(at.geometry.volume_gradient_um2), cell);
    for (std::size_t i = 0; i < S.size(); ++i) F_nN[i] += P * S[i];  // eqn (12)
}

std::optional<double> CytosolPressure::energy_fJ(const Configuration& at, int cell) const {
    const double eps = volume_strain(at, cell);
    const double target = at.model.target_volume_um3[static_cast<std::size_t>(cell)];
    const double K_kPa = parameters_.is_exact ? 0.0 : parameters_.K_kPa;
    return target * eps * (0.5 * K_kPa * eps - pressure_at_target_kPa(at, cell));
}

}  // namespace spheroscope
