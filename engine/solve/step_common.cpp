#include "engine/solve/step_common.hpp"

#include "engine/base/index.hpp"

#include <algorithm>
#include <cmath>

namespace spheroscope {

void describe_forces(System& system, StepOutcome& outcome) {
    double sum2 = 0.0;
    Vec3 sum = Vec3::Zero();
    for (const Vec3& f : system.force_nN()) {
        sum2 += f.squaredNorm();
        sum += f;
    }
    outcome.force_rms_nN = std::sqrt(sum2 / static_cast<double>(system.force_nN().size()));
    outcome.force_sum_nN = sum.norm();
}

void describe_powers(System& system, const State& state, bool freeze_volume_integral,
                     std::span<const Vec3> v_um_per_s, StepOutcome& outcome) {
    const Model& model = system.model();
    thread_local std::vector<Vec3> friction;
    friction.resize(v_um_per_s.size());
    system.friction_product(v_um_per_s, friction);
    outcome.dissipation_nN_um_per_s = 0.0;
    for (std::size_t i = 0; i < friction.size(); ++i)
        outcome.dissipation_nN_um_per_s += v_um_per_s[i].dot(friction[i]);

    outcome.drive_power_nN_um_per_s = 0.0;
    const SystemParts& parts = system.parts();
    if (parts.wall != nullptr && state.wall.acts()) {
        // At fixed x the wall's energy changes by -(sum of radial forces) dR.
        for (const Vec3& f : system.force_of_term(*parts.wall))
            outcome.drive_power_nN_um_per_s -= state.wall.speed_um_per_s * f.norm();
    }
    if (parts.cytosol != nullptr && !parts.cytosol->is_exact() && !freeze_volume_integral) {
        const Configuration at = system.configuration();
        for (int cell = 0; cell < model.n_cells(); ++cell) {
            const double strain = parts.cytosol->volume_strain(at, cell);
            outcome.drive_power_nN_um_per_s += parts.cytosol->K_kPa() / parts.cytosol->T_I_s() *
                                               model.target_volume_um3[idx(cell)] * strain * strain;
        }
    }
}

double largest_speed_um_per_s(std::span<const Vec3> v_um_per_s) {
    double largest2 = 0.0;
    for (const Vec3& v : v_um_per_s) largest2 = std::max(largest2, v.squaredNorm());
    return std::sqrt(largest2);
}

double largest_cell_rms(const Model& model, std::span<const Vec3> a, std::span<const Vec3> b) {
    double largest = 0.0;
    for (int cell = 0; cell < model.n_cells(); ++cell) {
        const std::span<const Vec3> p = model.cell_nodes(a, cell);
        const std::span<const Vec3> q = model.cell_nodes(b, cell);
        double sum2 = 0.0;
        for (std::size_t i = 0; i < p.size(); ++i) sum2 += (p[i] - q[i]).squaredNorm();
        largest = std::max(largest, sum2 / static_cast<double>(p.size()));
    }
    return std::sqrt(largest);
}

double largest_cell_rms(const Model& model, std::span<const Vec3> a) {
    double largest = 0.0;
    for (int cell = 0; cell < model.n_cells(); ++cell) {
        double sum2 = 0.0;
        for (const Vec3& v : model.cell_nodes(a, cell)) sum2 += v.squaredNorm();
        largest = std::max(largest, sum2 / static_cast<double>(model.n_nodes()));
    }
    return std::sqrt(largest);
}

double change_of_velocity_error_um(const Model& model, const State& state,
                                   std::span<const Vec3> v_um_per_s, double dt_s) {
    if (!state.has_velocity) return 0.0;
    return 0.5 * dt_s * largest_cell_rms(model, v_um_per_s, state.v_um_per_s);
}

void finish_step(State& state, std::vector<Vec3>& v_um_per_s, double end_s) {
    const double dt_s = end_s - state.time_s;
    for (std::size_t i = 0; i < v_um_per_s.size(); ++i) state.x_um[i] += dt_s * v_um_per_s[i];
    finish_step_at(state, state.x_um, v_um_per_s, end_s);
}

void finish_step_at(State& state, std::vector<Vec3>& x_um, std::vector<Vec3>& v_um_per_s,
                    double end_s) {
    if (&x_um != &state.x_um) std::swap(state.x_um, x_um);
    std::swap(state.v_um_per_s, v_um_per_s);
    state.has_velocity = true;
    if (state.wall.acts()) {
        state.wall.radius_um = state.wall.radius_at(end_s);
        state.wall.time_s = end_s;
    }
    state.time_s = end_s;
}

double step_end_s(double time_s, double dt_s, double limit_s) {
    const double remaining_s = limit_s - time_s;
    if (dt_s >= remaining_s * (1.0 - 1e-9)) return limit_s;
    if (2.0 * dt_s > remaining_s) return time_s + 0.5 * remaining_s;
    return time_s + dt_s;
}

}  // namespace spheroscope
