// The error that no time step can remove. Every level has edges half as long as the one before, so
// a measure with an error c h^p has successive differences in the ratio 2^p; three levels give p
// and the limit. Where the differences do not behave like that, nothing is extrapolated.

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
/// The finer setting has a step of 1/64; its own error is then below 2 % of that of the scene's.
constexpr double k_finer = 1.0 / 64.0;

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

MethodSetting finer_than(const MethodSetting& own) {
    MethodSetting setting = own;
    setting.linear_tolerance *= k_finer;
    // the tolerance of a first-order method falls with the square of the step
    if (own.is_fixed())
        setting.dt_s *= k_finer;
    else
        setting.tolerance_um *= k_finer * k_finer;
    return setting;
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
    result.finer = finer_than(result.own);
    const auto run = [&](const scene::Scene& which, const std::string& what,
                         double share) -> std::optional<MeasuredRun> {
        const double left_s = options.wall_limit_s - (wall_clock_s() - begin_s);
        const bool is_late = options.wall_limit_s > 0.0 && left_s <= 0.0;
        if (is_late || (options.stop != nullptr && options.stop->load())) {
            result.met_time_limit = true;
            return std::nullopt;
        }
        if (options.progress) options.progress(what, share);
        MeasuredRun done =
            measure_run(which, {.threads = options.threads,
                                .wall_limit_s = options.wall_limit_s > 0.0 ? left_s : 0.0,
                                .stop = options.stop});
        if (done.verdict == RunVerdict::time_limit) result.met_time_limit = true;
        done.samples.clear();
        return done;
    };
    // the finer run first: without it nothing can be compared
    const std::optional<MeasuredRun> fine =
        run(result.finer.applied_to(fixed), fmt::format("own mesh, {}", result.finer.text()), 0.0);
    for (const int nodes : {42, 162, 642, 2562}) {
        if (nodes > most_nodes) continue;
        const scene::Scene on_level = scene::on_mesh(fixed, nodes);
        std::optional<MeasuredRun> done =
            run(on_level, fmt::format("{} nodes", nodes), nodes / 2562.0);
        MeshLevel level{nodes, done.has_value(), {}};
        if (done) level.run = std::move(*done);
        result.levels.push_back(std::move(level));
    }
    for (const MeshMeasure& measure : all_mesh_measures()) {
        MeshResult row;
        double own = k_undefined;
        std::vector<double> known;
        for (const MeshLevel& level : result.levels) {
            const bool is_there = level.was_run && level.run.is_complete();
            row.values.push_back(is_there ? measure.value(level.run) : k_undefined);
            // a failed level spoils the sequence; one that was not run only shortens it
            if (level.was_run) known.push_back(row.values.back());
            if (level.nodes == scene.cells.nodes) own = row.values.back();
        }
        row.extrapolation = extrapolate(known);
        row.mesh_error = std::abs(own / row.extrapolation.limit - 1.0);
        const double exact = fine && fine->is_complete() ? measure.value(*fine) : k_undefined;
        row.time_error = std::abs(own / exact - 1.0);
        result.results.push_back(row);
    }
    return result;
}

}  // namespace spheroscope::reports
