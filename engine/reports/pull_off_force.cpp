// The pull-off force of two cells depends on how it is measured: here both cells are pulled as
// wholes, by body forces, and the force is controlled, so a contact parts where its force over
// distance has its maximum. Pulling with the cells' poles held, or at a given distance, would give
// another number (Vishen, Prost and Sens, EPJ E 47, 2024). Limits for spheres of work of adhesion W
// are 3/4 pi R W (JKR, elastic solids) and pi R W (Derjaguin, Muller and Toporov; liquids of high
// tension).

#include "engine/reports/pull_off_force.hpp"

#include "engine/reports/variants.hpp"
#include "engine/run/engine.hpp"
#include "engine/stages/choices.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace spheroscope::reports {
namespace {

constexpr double k_hold_s = 0.5;
constexpr double k_largest_over_pi_R_W = 3.0;  // a force that no theory knows: something is wrong

/// A force on cell 0 and its opposite on cell 1, spread by rest area; its strength is the report's.
class Pull final : public ForceTerm {
  public:
    explicit Pull(const Vec3* force_nN) : ForceTerm(Loc{}), force_nN_(force_nN) {}
    [[nodiscard]] std::string_view name() const override { return "pull"; }
    [[nodiscard]] Need needs() const override { return Need::none; }
    void add_force(const Configuration& at, int cell, std::span<Vec3> F_nN) const override {
        const Vec3 per_area = (cell == 0 ? 1.0 : -1.0) / at.model.unit_area * *force_nN_;
        for (std::size_t i = 0; i < F_nN.size(); ++i)
            F_nN[i] += at.model.unit_node_area[i] * per_area;
    }

  private:
    const Vec3* force_nN_;
};

void check(const scene::Scene& scene) {
    const auto want = [&](bool holds, const char* what) {
        if (!holds)
            throw Error(Loc{scene.file, 0, 0}, fmt::format("a pull-off wants {}", what),
                        "scenes/claims/pull_off.toml is one");
    };
    want(scene.cells.count == 2, "two cells");
    want(scene.contact && scene.contact->adhesive, "[contact.adhesion]");
    want(scene.cortex.tension.has_value(), "[cortex.tension]");
    want(scene.cortex.elastic.has_value(), "[cortex.elastic]");
    want(!scene.body_force, "no [load.body_force]: it brings its own");
    want(chosen_method(scene).moves_in_time(), "a method whose motion is one in time");
    const std::vector<double> radii = cell_radii(scene, {});
    want(radii[0] == radii[1], "cells of one radius");
    for (const scene::Stage& stage : scene.stages)
        want(stage.kind == scene::StageKind::relax && stage.nodes == scene.cells.nodes,
             "stages of kind \"relax\" on one mesh");
}

Vec3 centre_of(const Model& model, std::span<const Vec3> x_um, int cell) {
    Vec3 sum = Vec3::Zero();
    for (const Vec3& x : model.cell_nodes(x_um, cell)) sum += x;
    return sum / model.n_nodes();
}

PullOff pull_apart(const scene::Scene& scene, const PullOffOptions& options) {
    PullOff result;
    result.E_kPa = scene.cortex.elastic->E_kPa;
    result.Et_over_gamma =
        result.E_kPa * scene.cortex.thickness_um / scene.cortex.tension->gamma_nN_per_um;
    const double R_um = cell_radii(scene, {})[0];
    const double unit_nN = std::numbers::pi * R_um * scene.contact->W_nN_per_um;

    const std::atomic<bool> never{false};
    Engine engine(scene, {.threads = options.threads, .version = "", .command_line = ""});
    EngineSinks sinks;
    sinks.frame = [](const SnapshotPtr&) -> std::optional<std::string> { return {}; };
    const RunResult rest = engine.run(sinks, options.stop != nullptr ? *options.stop : never);
    result.area_at_rest_um2 = rest.totals.contact_area_um2;
    if (rest.verdict != RunVerdict::finished && rest.verdict != RunVerdict::cap) {
        result.problem = rest.outcome + (rest.message.empty() ? "" : ": " + rest.message);
        return result;
    }
    if (!(result.area_at_rest_um2 > 0.0)) {
        result.problem = "the cells do not touch at rest: there is nothing to pull at";
        return result;
    }

    Vec3 force_nN = Vec3::Zero();
    SystemParts parts = build_parts(scene);
    parts.terms.push_back(std::make_unique<Pull>(&force_nN));
    System system(make_model(make_icosphere(scene.cells.nodes), cell_radii(scene, {})),
                  std::move(parts), options.threads, Need::triangles | Need::volumes);
    const auto method = chosen_method(scene).make(method_parameters(scene));
    State state = engine.state().state;
    const double start_s = state.time_s;
    while (true) {
        const Vec3 line =
            centre_of(system.model(), state.x_um, 0) - centre_of(system.model(), state.x_um, 1);
        const double strength_nN = options.rate_nN_per_s * (state.time_s - start_s);
        force_nN = strength_nN * line.normalized();
        const double limit_s = state.time_s + k_hold_s;
        while (state.time_s < limit_s) {
            const StepOutcome step = method->advance(system, state, limit_s, false);
            if (!step.accepted) {
                result.problem = step.trouble->text();
                return result;
            }
            ++result.steps;
        }
        result.time_s = state.time_s;
        if (system.contacts().n_pairs() == 0) break;
        result.force_nN = strength_nN;
        result.over_pi_R_W = strength_nN / unit_nN;
        if (result.over_pi_R_W > k_largest_over_pi_R_W) {
            result.problem = "the cells hold more than any theory says";
            return result;
        }
        if (options.stop != nullptr && options.stop->load()) {
            result.problem = "stopped";
            return result;
        }
    }
    return result;
}

}  // namespace

std::vector<PullOff> measure_pull_off(const std::string& file,
                                      const std::vector<scene::Override>& overrides,
                                      const PullOffOptions& options) {
    std::vector<PullOff> rows;
    const scene::Scene scene = scene::load_scene(file, overrides);
    std::vector<scene::Variant> variants = scene.variants;
    if (variants.empty()) variants.emplace_back();
    for (const scene::Variant& variant : variants) {
        std::vector<scene::Override> changes = overrides;
        for (scene::Override& change : overrides_of(variant)) changes.push_back(std::move(change));
        const scene::Scene changed = scene::load_scene(file, changes);
        check(changed);
        if (options.progress)
            options.progress(variant.name, static_cast<double>(rows.size()) /
                                               static_cast<double>(variants.size()));
        const bool is_stopped = options.stop != nullptr && options.stop->load();
        rows.push_back(is_stopped ? PullOff{} : pull_apart(changed, options));
        if (is_stopped) rows.back().problem = k_not_run;
        rows.back().variant = variant.name;
    }
    return rows;
}

Plot pull_off_plot(const std::vector<PullOff>& rows) {
    Plot::Series measured;
    measured.name = "two cells";
    for (const PullOff& row : rows) {
        if (!row.problem.empty()) continue;
        measured.x.push_back(row.Et_over_gamma);
        measured.y.push_back(row.over_pi_R_W);
    }
    Plot plot;
    plot.title = "Force that parts two cells";
    plot.columns = 1;
    plot.legend_above = true;
    Plot::Panel panel{"", "E t / \u03b3", "F / \u03c0 R W"};
    panel.series = {measured};
    panel.y_axis.is_logarithmic = false;
    panel.bands = {{0.75, 0.75, "JKR, elastic spheres"}, {1.0, 1.0, "DMT, liquid spheres"}};
    plot.panels = {panel};
    return plot;
}

}  // namespace spheroscope::reports
