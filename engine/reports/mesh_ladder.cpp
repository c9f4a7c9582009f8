// The error that no time step can remove, so every level is run with steps so fine that theirs does
// not matter: with the scene's own ones a method that lags does so more or less on each mesh, and
// the lag would pass for an error of the mesh. Every level has edges half as long as the one
// before, so a measure with an error c h^p has successive differences in the ratio 2^p; three
// levels give p and the limit. Where the differences do not behave like that, nothing is
// extrapolated.

#include "engine/reports/mesh_ladder.hpp"

#include "engine/reports/machine.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>

namespace spheroscope::reports {
namespace {

constexpr double k_undefined = std::numeric_limits<double>::quiet_NaN();
/// A smaller observed order makes the limit a matter of chance: it lies 2.4 differences away.
constexpr double k_least_order = 0.5;
/// Steps of the finer setting over those of the scene, or what is as fine: of second order, their
/// error is 1/64. A first-order method would need 64 times as many steps for that, and
/// linearly_implicit more (engine/README.md, 'How wrong'), so the finer setting has another one.
constexpr double k_finer = 1.0 / 8.0;
constexpr std::string_view k_finer_method = "rosenbrock_w";

double rms(std::span<const float> values) {
    double sum2 = 0.0;
    for (const float value : values) sum2 += double{value} * double{value};
    return values.empty() ? k_undefined : std::sqrt(sum2 / static_cast<double>(values.size()));
}

double contact_area(const MeasuredRun& run) {
    return run.end.totals.contact_area_um2 > 0.0 ? run.end.totals.contact_area_um2 : k_undefined;
}
double mean_pressure(const MeasuredRun& run) { return run.end.totals.mean_pressure_kPa; }
double gamma_eff(const MeasuredRun& run) { return rms(run.end.gamma_eff_nN_per_um); }
double sigma_h(const MeasuredRun& run) { return rms(run.end.sigma_h_kPa); }
double pair_force(const MeasuredRun& run) {
    std::vector<float> forces;
    for (const ContactLink& link : run.end.links) forces.push_back(link.force_nN);
    return rms(forces);
}
double energy(const MeasuredRun& run) { return run.end.totals.energy_fJ; }

MethodSetting finer_than(const scene::Scene& scene, const MethodSetting& own) {
    MethodSetting setting = own;
    setting.linear_tolerance *= k_finer;
    if (own.method->order < 2) {
        setting.method = find_method(k_finer_method);
        setting.tolerance_um = standard_tolerance_um(scene);
    }
    if (setting.is_fixed())
        setting.dt_s *= k_finer;
    else
        setting.tolerance_um *= std::pow(k_finer, setting.method->estimate_order);
    return setting;
}

/// The scene at that setting, with the bounds of its steps as far down.
scene::Scene made_finer(const scene::Scene& scene, const MethodSetting& setting) {
    scene::Scene finer = setting.applied_to(scene);
    finer.method.dt_min_s *= std::pow(k_finer, 2.0);
    finer.method.displacement_bound_h0 *= k_finer;
    return finer;
}

}  // namespace

std::span<const MeshMeasure> all_mesh_measures() {
    static constexpr std::array<MeshMeasure, 6> rows{{
        {"contact_area", "um^2", contact_area},
        {"mean_pressure", "kPa", mean_pressure},
        {"gamma_eff_rms", "nN/um", gamma_eff},
        {"sigma_h_rms", "kPa", sigma_h},
        {"pair_force_rms", "nN", pair_force},
        {"energy", "fJ", energy},
    }};
    return rows;
}

std::string_view MeshResult::dominant() const {
    if (!std::isfinite(mesh_error) || !std::isfinite(time_error)) return "unknown";
    return mesh_error > time_error ? "mesh" : "time";
}

Extrapolation extrapolate(std::span<const double> values) {
    Extrapolation result{k_undefined, k_undefined, false};
    if (values.size() < 3) return result;
    const double a = values[values.size() - 3], b = values[values.size() - 2], c = values.back();
    const double ratio = (b - a) / (c - b);
    if (!std::isfinite(ratio) || !(ratio > 1.0)) return result;
    const double order = std::log2(ratio);
    if (order < k_least_order) return result;
    return {order, c + (c - b) / (ratio - 1.0), true};
}

MeshLadder compute_mesh_ladder(const scene::Scene& scene, int most_nodes,
                               const PrecisionOptions& options) {
    const double begin_s = wall_clock_s();
    const scene::Scene fixed = with_fixed_outputs(scene, options.n_outputs);
    MeshLadder result;
    result.own = own_setting(scene);
    result.finer = finer_than(scene, result.own);
    const scene::Scene finer = made_finer(fixed, result.finer);
    const auto run = [&](const scene::Scene& which, const std::string& what,
                         double share) -> MeshLevel {
        const double left_s = options.wall_limit_s - (wall_clock_s() - begin_s);
        const bool is_late = options.wall_limit_s > 0.0 && left_s <= 0.0;
        if (is_late || (options.stop != nullptr && options.stop->load())) {
            result.met_time_limit = true;
            return {which.cells.nodes, false, {}};
        }
        if (options.progress) options.progress(what, share);
        MeasuredRun done =
            measure_run(which, {.threads = options.threads,
                                .wall_limit_s = options.wall_limit_s > 0.0 ? left_s : 0.0,
                                .stop = options.stop});
        if (done.verdict == RunVerdict::time_limit) result.met_time_limit = true;
        done.samples.clear();
        return {which.cells.nodes, true, std::move(done)};
    };
    // the scene's own mesh first: without it nothing can be compared
    result.finer_run = run(finer, fmt::format("own mesh, {}", result.finer.text()), 0.0);
    result.own_run = run(fixed, fmt::format("own mesh, {}", result.own.text()), 0.0);
    for (const int nodes : {42, 162, 642, 2562}) {
        if (nodes > most_nodes) continue;
        result.levels.push_back(nodes == scene.cells.nodes
                                    ? result.finer_run
                                    : run(scene::on_mesh(finer, nodes),
                                          fmt::format("{} nodes", nodes), nodes / 2562.0));
    }
    const auto value_on = [](const MeshMeasure& measure, const MeshLevel& level) {
        return level.was_run && level.run.is_complete() ? measure.value(level.run) : k_undefined;
    };
    for (const MeshMeasure& measure : all_mesh_measures()) {
        MeshResult row;
        std::vector<double> known;
        double finest = k_undefined;
        for (const MeshLevel& level : result.levels) {
            row.values.push_back(value_on(measure, level));
            // a failed level spoils the sequence; one that was not run only shortens it
            if (level.was_run) known.push_back(row.values.back());
            if (level.nodes > scene.cells.nodes && std::isfinite(row.values.back()))
                finest = row.values.back();
        }
        row.extrapolation = extrapolate(known);
        row.mesh_error_is_rough = !row.extrapolation.is_resolved && std::isfinite(finest);
        const double exact = value_on(measure, result.finer_run);
        row.mesh_error =
            std::abs(exact / (row.mesh_error_is_rough ? finest : row.extrapolation.limit) - 1.0);
        row.time_error = std::abs(value_on(measure, result.own_run) / exact - 1.0);
        result.results.push_back(row);
    }
    return result;
}

}  // namespace spheroscope::reports
