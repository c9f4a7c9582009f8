// What an engine measures: the totals of a state, and how wrong those of the end are.

#include "engine/run/engine.hpp"
#include "engine/run/expectations.hpp"
#include "engine/stages/choices.hpp"

#include <algorithm>
#include <cmath>

namespace spheroscope {
namespace {

/// What hull and probe do to the cells in the system's last evaluation.
void add_load(const System& system, const Load& load, Totals& totals) {
    const Configuration at = system.configuration();
    Vec3 sum_nN = Vec3::Zero();
    for (const Vec3& f : system.force_nN()) sum_nN += f;
    const Vec3& way = load.probe.direction;
    totals.probe_way_um = load.probe.way_um;
    totals.probe_force_nN = system.parts().probe->sum_nN(at).dot(way);
    totals.hull_force_nN = -system.parts().hull->sum_nN(at).dot(way);
    totals.load_imbalance = sum_nN.norm() / load.probe.force_nN;
}

}  // namespace

void Engine::compute_cell_measures(const Configuration& at) {
    pressure_kPa_.clear();
    if (const CytosolPressure* cytosol = system_->parts().cytosol)
        for (int cell = 0; cell < at.model.n_cells(); ++cell)
            pressure_kPa_.push_back(cytosol->pressure_kPa(at, cell));
    cell_stress_kPa_.clear();
    if (system_->parts().contact) cell_stress_kPa_ = cell_stress_tensors(at, system_->workers());
}

MeasureInput Engine::measure_input(const Configuration& at) const {
    MeasureInput input{.at = at,
                       .v_um_per_s = run_.state.v_um_per_s,
                       .spring_nN_per_um = spring_nN_per_um_,
                       .pressure_kPa = {},
                       .cell_stress_kPa = {}};
    input.touching_area_um2 = scene_.measures.touching_area_um2;
    if (scene_.cortex.tension) input.gamma_nN_per_um = scene_.cortex.tension->gamma_nN_per_um;
    input.pressure_kPa = pressure_kPa_;
    input.cell_stress_kPa = cell_stress_kPa_;
    if (scene_.contact && scene_.contact->adhesive) {
        input.omega_nN_per_um = scene_.contact->omega_nN_per_um;
        input.W_nN_per_um = scene_.contact->W_nN_per_um;
    }
    return input;
}

Totals Engine::measure() {
    const double wall_um = run_.state.wall.acts() ? run_.state.wall.radius_um : 0.0;
    // What is not finite here is found again, and reported, by the next step.
    static_cast<void>(
        system_->evaluate(run_.state.x_um, run_.state.volume_integral_s, wall_um, run_.state.load));
    const Configuration at = system_->configuration();
    compute_cell_measures(at);
    Totals totals = compute_totals(measure_input(at));
    if (!cell_stress_kPa_.empty()) {
        const std::vector<double> inside =
            hydrostatic_stress_from_inside(at, cell_stress_kPa_, system_->force_nN());
        double difference2 = 0.0, size2 = 0.0;
        for (std::size_t cell = 0; cell < inside.size(); ++cell) {
            const double sigma_h = cell_stress_kPa_[cell].trace() / 3.0;
            difference2 += (sigma_h - inside[cell]) * (sigma_h - inside[cell]);
            size2 += sigma_h * sigma_h;
        }
        if (size2 > 0.0) totals.virial_identity = std::sqrt(difference2 / size2);
    }
    if (run_.state.load.probe.acts()) add_load(*system_, run_.state.load, totals);
    if (is_expected(scene_, "deepest_node"))
        totals.deepest_node_um = compute_deepest_node_um(at, system_->workers());
    const double energy_fJ = system_->energy_fJ();
    totals.energy_fJ = energy_fJ;
    if (run_.diagnostics.steps > 0) totals.dissipation_nN_um_per_s = run_.dissipation_nN_um_per_s;
    if (run_.has_energy && run_.dissipated_fJ > 0.0)
        totals.power_residual =
            (energy_fJ - run_.energy_fJ + run_.dissipated_fJ - run_.driven_fJ) / run_.dissipated_fJ;
    run_.energy_fJ = energy_fJ;
    run_.has_energy = true;
    run_.dissipated_fJ = 0.0;
    run_.driven_fJ = 0.0;
    Diagnostics& d = run_.diagnostics;
    d.wall_radius_um = wall_um;
    d.wall_force_nN = 0.0;
    if (wall_um > 0.0)
        for (const Vec3& f : system_->force_of_term(*system_->parts().wall))
            d.wall_force_nN += f.norm();
    return totals;
}

std::optional<Totals> Engine::totals_moved_by(std::span<const Vec3> displacement_um) {
    if (displacement_um.size() != run_.state.x_um.size()) return {};
    std::vector<Vec3> x_um = run_.state.x_um;
    for (std::size_t i = 0; i < x_um.size(); ++i) x_um[i] += displacement_um[i];
    if (system_->evaluate(x_um, run_.state.volume_integral_s, 0.0, run_.state.load)) return {};
    const Configuration at = system_->configuration();
    compute_cell_measures(at);
    Totals totals = compute_totals(measure_input(at));
    totals.energy_fJ = system_->energy_fJ();
    return totals;
}

std::vector<MeasureError> Engine::estimate_errors() {
    if (run_.diagnostics.steps == 0 || scene_.stages.empty()) return {};
    // Only what was to come to rest is wrong by not being there.
    const bool wants_rest =
        std::any_of(scene_.stages.begin(), scene_.stages.end(), [](const scene::Stage& stage) {
            return stage.until != scene::Until::duration;
        });
    const double last_step_s = run_.approach.last_step_s();
    std::optional<Totals> before;
    if (wants_rest && last_step_s > 0.0) {
        std::vector<Vec3> back_um;
        for (const Vec3& v : run_.state.v_um_per_s) back_um.push_back(-last_step_s * v);
        before = totals_moved_by(back_um);
    }
    std::vector<MeasureError> errors =
        measure_errors(result_.totals, before ? &*before : nullptr, last_step_s,
                       run_.approach.missing_time_s(run_.state.time_s - run_.memory.start_s));
    for (MeasureError& error : errors)
        error.halves_time = advice_on_time_steps(chosen_method(scene_), has_fixed_steps(scene_));
    return errors;
}

}  // namespace spheroscope
