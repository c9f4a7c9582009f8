// One run from top to bottom: stages one after another; in a stage, steps to the next output; at an
// output, measures and a snapshot. Everything that decides what comes next is in RunState, so a run
// that goes on from a checkpoint does the same steps as one that was never stopped.

#include "engine/run/engine.hpp"

#include "engine/base/index.hpp"
#include "engine/contact/simd_target.hpp"
#include "engine/forces/in_plane_elasticity.hpp"
#include "engine/run/expectations.hpp"
#include "engine/run/health.hpp"
#include "engine/run/snapshot_maker.hpp"
#include "engine/stages/choices.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace spheroscope {
namespace {

constexpr double k_unknown = std::numeric_limits<double>::quiet_NaN();

/// Interval of measurements in a stage that has no outputs of its own but a condition to check; in
/// steps where the method's time is no time.
constexpr double k_check_every_s = 1.0;
constexpr int k_check_every_steps = 20;

/// A thread that has less to do than this spends its time waiting for the others: on a busy machine
/// a doublet of 162 nodes took forty times as long on two threads as on one.
constexpr std::size_t k_nodes_per_thread = 1000;

/// Model time that cells have to part in before they must not lie inside each other.
constexpr double k_parting_s = 1.0;

/// Steps of annealing between two looks at the stop flag.
constexpr int k_anneal_chunk = 200;

double wall_clock_s() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

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

Engine::Engine(const scene::Scene& scene, const EngineOptions& options,
               const std::optional<GivenCells>& given)
    : scene_(scene), options_(options) {
    method_ = chosen_method(scene).make(method_parameters(scene));
    run_.radius_um = cell_radii(scene, given);
    header_ = std::make_shared<RunHeader>();
    header_->topology = make_icosphere(scene.cells.nodes);
    if (given && given->held) held_force_nN_ = given->held->force_nN;
    use_mesh(scene.stages.front().nodes);
    const Model& model = system_->model();
    run_.state.x_um = start_positions(scene, model, given);
    run_.state.v_um_per_s.assign(model.n_all_nodes(), Vec3::Zero());
    run_.state.volume_integral_s.assign(model.radius_um.size(), 0.0);
    if (given && given->held) run_.state.volume_integral_s = given->held->volume_integral_s;

    header_->n_cells = model.n_cells();
    header_->title = scene.title;
    header_->scene_name = scene.file.substr(scene.file.find_last_of('/') + 1);
    header_->resolved_scene = scene.resolved_toml;
    header_->seed = scene.seed;
    header_->version = options.version;
    header_->command_line = options.command_line;
    if (scene.contact && scene.contact->law == scene::ContactLaw::variational)
        header_->contact_arithmetic = "double";
    else if (scene.contact)
        header_->contact_arithmetic =
            (scene.contact->precision == scene::Precision::single_precision ? "float, "
                                                                            : "double, ") +
            simd_target();
    header_->fields = chosen_fields(scene);
    // A change that cannot be made is found now, not after hours.
    scene::Scene changed = scene;
    for (const Change& change : options.changes) apply_change(changed, change);
    for (const double radius : model.radius_um)
        header_->radius_um.push_back(static_cast<float>(radius));
}

void Engine::use_mesh(int n_nodes) {
    const bool as_frames = n_nodes == header_->topology->n_nodes();
    const double target_strain = scene_.cytosol ? scene_.cytosol->target_strain : 0.0;
    Model model = make_model(as_frames ? header_->topology : make_icosphere(n_nodes),
                             run_.radius_um, target_strain);
    to_frames_.reset();
    if (!as_frames) to_frames_.emplace(model.topology, header_->topology);
    spring_nN_per_um_.clear();
    if (scene_.cortex.elastic) {
        const MeshTopology& mesh = *model.topology;
        for (std::size_t e = 0; e < mesh.edges.size(); ++e)
            spring_nN_per_um_.push_back(k_spring_nN_per_um(
                scene_.cortex.elastic->E_kPa, scene_.cortex.thickness_um,
                model.unit_triangle_area[idx(mesh.edges[e].left)],
                model.unit_triangle_area[idx(mesh.edges[e].right)], model.unit_edge_length[e]));
    }
    if (system_) earlier_work_.add(system_->work());
    system_.reset();  // one of them at a time in memory
    const int n_threads =
        std::clamp(static_cast<int>(model.n_all_nodes() / k_nodes_per_thread), 1, options_.threads);
    // Measures look at normals and volumes even where no force needs them.
    system_ = std::make_unique<System>(std::move(model), build_parts(scene_, held_force_nN_),
                                       n_threads, Need::triangles | Need::volumes);
    for (const Field& field : all_fields())
        system_->counters().fields.push_back({std::string(field.name), 0});
}

void Engine::refine_to(int n_nodes) {
    if (system_->model().n_nodes() == n_nodes) return;
    const std::shared_ptr<const MeshTopology> coarse = system_->model().topology;
    const int n_cells = system_->model().n_cells();
    use_mesh(n_nodes);
    State& state = run_.state;
    state.x_um =
        prolonged_positions(Prolongation(coarse, system_->model().topology), n_cells, state.x_um);
    // The new nodes are not at rest relative to the old ones: begin with small steps.
    state.v_um_per_s.assign(state.x_um.size(), Vec3::Zero());
    state.has_velocity = false;
    state.next_dt_s = 0.0;
    run_.errors.forget_velocities();
}

Engine::~Engine() = default;

void Engine::resume(const RunState& run) {
    const bool is_over = run.stage >= static_cast<int>(scene_.stages.size());
    const int stage = is_over ? static_cast<int>(scene_.stages.size()) - 1 : run.stage;
    // A stage that has not begun is still on the mesh of the one before.
    const int n_nodes =
        scene_.stages[idx(!is_over && !run.stage_has_begun && stage > 0 ? stage - 1 : stage)].nodes;
    if (run.radius_um != run_.radius_um ||
        run.state.x_um.size() != run.radius_um.size() * idx(n_nodes))
        throw Error("the checkpoint is of other cells than the scene",
                    "resume with the scene that the run began with");
    const std::size_t n_before = n_changes_applied_;
    while (n_changes_applied_ < options_.changes.size() &&
           options_.changes[n_changes_applied_].time_s < run.state.time_s)
        make_change(options_.changes[n_changes_applied_++]);
    const bool has_changed = n_changes_applied_ > n_before;
    if (has_changed) method_ = chosen_method(scene_).make(method_parameters(scene_));
    if (has_changed || system_->model().n_nodes() != n_nodes) use_mesh(n_nodes);
    run_ = run;
}

RunResult Engine::run(const EngineSinks& sinks, const std::atomic<bool>& stop) {
    sinks_ = &sinks;
    stop_ = &stop;
    started_wall_s_ = checkpointed_wall_s_ = wall_clock_s();
    result_ = {};
    if (sinks.live != nullptr) sinks.live->begin(header_);
    const int n_stages = static_cast<int>(scene_.stages.size());
    Next next = Next::go_on;
    while (next == Next::go_on && run_.stage < n_stages) {
        const scene::Stage& stage = scene_.stages[idx(run_.stage)];
        next = stage.kind == scene::StageKind::anneal ? anneal(stage) : advance(stage);
    }
    if (next == Next::go_on) {
        result_.verdict = run_.met_cap ? RunVerdict::cap : RunVerdict::finished;
        result_.outcome = run_.met_cap ? "cap" : std::string(name_of(run_.end));
        write_checkpoint();
        result_.errors = estimate_errors();
    }
    result_.wall_s = wall_clock_s() - started_wall_s_;
    result_.work = earlier_work_;
    result_.work.add(system_->work());
    result_.work.steps = run_.diagnostics.steps;
    result_.work.rejected_steps = run_.diagnostics.rejected_steps;
    result_.time_s = run_.state.time_s;
    result_.time_is_physical = chosen_method(scene_).order > 0;
    result_.frames = run_.frames;
    result_.state_hash = run_.state.hash();
    return result_;
}

Engine::Next Engine::anneal(const scene::Stage& stage) {
    const Model& model = system_->model();
    BeadPacking packing(run_.radius_um, packing_parameters(stage), scene_.seed);
    if (run_.stage_has_begun) packing.restore(run_.beads);
    const auto put_cells = [&] {
        place_cells(model, packing.centre_um(), scene_.seed, run_.state.x_um);
    };
    run_.stage_has_begun = true;
    // Frames are spread evenly over the annealing steps; the last one is the finished packing.
    const auto frame_step = [&](std::int64_t frame) {
        return static_cast<int>(frame * stage.steps / std::max(1, stage.frames - 1));
    };
    while (!packing.is_finished()) {
        const bool frame_is_due = stage.frames > 1 && run_.outputs_in_stage < stage.frames - 1 &&
                                  packing.state().step == frame_step(run_.outputs_in_stage);
        if (frame_is_due) {
            put_cells();
            ++run_.outputs_in_stage;
            if (publish(measure(), packing.progress()) == Next::stop) return Next::stop;
        }
        int n_steps = k_anneal_chunk;
        if (run_.outputs_in_stage < stage.frames - 1 &&
            packing.state().phase == PackingPhase::annealing)
            n_steps = std::min(
                n_steps, std::max(1, frame_step(run_.outputs_in_stage) - packing.state().step));
        packing.advance(n_steps);
        run_.beads = packing.state();
        if (between_steps(packing.progress()) == Next::stop) return Next::stop;
    }
    const PackingOutcome outcome = packing.outcome();
    if (outcome.verdict != PackingVerdict::packed) {
        result_.verdict = RunVerdict::unstable;
        result_.outcome = "not packed";
        result_.message = stage.loc.text() + ": " + outcome.reason;
        return Next::stop;
    }
    put_cells();
    if (stage.frames > 0) {
        ++run_.outputs_in_stage;
        if (publish(measure(), 1.0) == Next::stop) return Next::stop;
    }
    run_.beads = {};
    finish_stage(StageEnd::done);
    return Next::go_on;
}

bool Engine::checks_by_steps_in(const scene::Stage& stage) const {
    // A check in between must not shorten the steps of a method that only looks for the end.
    return stage.every_s == 0.0 && !chosen_method(scene_).moves_in_time();
}

double Engine::next_output_s(const scene::Stage& stage) const {
    if (checks_by_steps_in(stage)) return std::numeric_limits<double>::infinity();
    const double interval_s = stage.every_s > 0.0 ? stage.every_s : k_check_every_s;
    return run_.memory.start_s + interval_s * static_cast<double>(run_.outputs_in_stage + 1);
}

// By value: changes make the scene anew.
Engine::Next Engine::advance(const scene::Stage parameters) {
    const std::unique_ptr<Stage> stage = make_stage(parameters);
    if (!run_.stage_has_begun) {
        refine_to(parameters.nodes);
        run_.memory.start_s = run_.state.time_s;
        // A relaxation after another one on the same mesh goes on looking at the same motion.
        if (!goes_on_relaxing()) run_.memory.samples.clear();
        StageContext context{*system_, run_.state, run_.memory};
        stage->begin(context);
        run_.stage_has_begun = true;
        run_.has_energy = false;
        if (run_.frames == 0 && parameters.every_s > 0.0 &&
            publish(measure(), 0.0) == Next::stop)  // the start itself is a frame
            return Next::stop;
    }
    const bool checks_by_steps = checks_by_steps_in(parameters);
    StageEnd end = StageEnd::none;
    while (end == StageEnd::none) {
        apply_changes();  // may make another system
        StageContext context{*system_, run_.state, run_.memory};
        const double output_s = next_output_s(parameters);
        const double limit_s = std::min(output_s, stage->latest_end_s(context));
        const StepOutcome step =
            method_->advance(*system_, run_.state, limit_s, run_.state.wall.acts());
        Diagnostics& d = run_.diagnostics;
        d.rejected_steps += step.rejected;
        d.linear_iterations += step.linear_iterations;
        if (!step.accepted) {
            write_checkpoint();
            Trouble trouble = *step.trouble;
            name_flattest_triangle(system_->model(), run_.state.x_um, trouble);
            return stop_unstable(step.dt_s, trouble);
        }
        ++d.steps;
        run_.errors.after_step(step.dt_s, run_.state.v_um_per_s);
        d.dt_s = step.dt_s;
        d.force_residual_nN = step.force_rms_nN;
        d.force_balance_nN = step.force_sum_nN;
        d.step_error_um = step.error_um;
        run_.dissipation_nN_um_per_s = step.dissipation_nN_um_per_s;
        run_.dissipated_fJ += step.dt_s * step.dissipation_nN_um_per_s;
        run_.driven_fJ += step.dt_s * step.drive_power_nN_um_per_s;
        end = stage->after_step(context);
        const bool is_due = run_.state.time_s >= output_s ||
                            (checks_by_steps && d.steps % k_check_every_steps == 0);
        if (end != StageEnd::none || is_due) {
            if (run_.state.time_s >= output_s) ++run_.outputs_in_stage;
            const Totals totals = measure();
            run_.errors.after_measurement(run_.state.time_s, run_.state.v_um_per_s);
            if (end == StageEnd::none || end == StageEnd::cap || end == StageEnd::done) {
                const StageEnd met = stage->after_measure(context, totals);
                if (met != StageEnd::none) end = met;
            }
            const bool is_output = parameters.every_s > 0.0 || end != StageEnd::none;
            if (is_output && publish(totals, stage->progress(context)) == Next::stop)
                return Next::stop;
            // Overlapping beads leave overlapping cells, which part in a fraction of this time.
            if (run_.state.time_s >= k_parting_s && scene_.contact)
                if (const auto trouble =
                        cells_inside_each_other(*system_, run_.state.x_um, scene_.contact->loc))
                    return stop_unstable(step.dt_s, *trouble);
        }
        if (end == StageEnd::none) {
            const double progress = stage->progress(context);
            show_look(progress);
            const std::function<double()> next_limit_s = [&] {
                StageContext now{*system_, run_.state, run_.memory};
                return std::min(next_output_s(parameters), stage->latest_end_s(now));
            };
            if (between_steps(progress, next_limit_s) == Next::stop) return Next::stop;
        }
    }
    StageContext context{*system_, run_.state, run_.memory};
    stage->end(context);
    finish_stage(end);
    return Next::go_on;
}

Engine::Next Engine::stop_unstable(double dt_s, const Trouble& trouble) {
    result_.verdict = RunVerdict::unstable;
    result_.outcome = "unstable";
    result_.message = "t = " + std::to_string(run_.state.time_s) + " s, step " +
                      std::to_string(run_.diagnostics.steps) + ", dt = " + std::to_string(dt_s) +
                      " s: " + trouble.text();
    return Next::stop;
}

void Engine::finish_stage(StageEnd end) {
    run_.end = end;
    if (end == StageEnd::cap) run_.met_cap = true;
    ++run_.stage;
    run_.stage_has_begun = false;
    run_.outputs_in_stage = 0;
    write_checkpoint();
}

bool Engine::goes_on_relaxing() const {
    if (run_.stage == 0) return false;
    const scene::Stage &stage = scene_.stages[idx(run_.stage)],
                       &before = scene_.stages[idx(run_.stage - 1)];
    return stage.kind == scene::StageKind::relax && before.kind == scene::StageKind::relax &&
           stage.nodes == before.nodes;
}

std::vector<MeasureError> Engine::estimate_errors() {
    if (run_.diagnostics.steps == 0 || scene_.stages.empty()) return {};
    const ErrorCollector& seen = run_.errors;
    const std::optional<Totals> before = totals_moved_by(seen.last_step_back_um());
    // Only what was to come to rest is wrong by not being there.
    const bool wants_rest =
        std::any_of(scene_.stages.begin(), scene_.stages.end(), [](const scene::Stage& stage) {
            return stage.until != scene::Until::duration;
        });
    const MethodRow& method = chosen_method(scene_);
    std::vector<MeasureError> errors =
        measure_errors(result_.totals, before ? &*before : nullptr, seen.last_step_s(),
                       seen.time_error_s(method.order),
                       wants_rest ? seen.missing_time_s(run_.state.time_s) : k_unknown);
    for (MeasureError& error : errors)
        error.halves_time = advice_on_time_steps(method, has_fixed_steps(scene_));
    return errors;
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

std::shared_ptr<Snapshot> Engine::snapshot_of(const Totals& totals, double progress) {
    const Configuration at = system_->configuration();
    auto snapshot =
        std::make_shared<Snapshot>(make_snapshot(header_, measure_input(at), run_.diagnostics,
                                                 totals, system_->counters(), system_->workers()));
    if (to_frames_) prolong(*snapshot, *to_frames_);
    snapshot->frame = -1;
    snapshot->time_s = run_.state.time_s;
    snapshot->stage = run_.stage;
    snapshot->stage_name = name_of(scene_.stages[idx(run_.stage)].kind);
    snapshot->stage_progress = progress;
    snapshot->load = run_.state.load;
    snapshot->changes = changes_made_;
    return snapshot;
}

Engine::Next Engine::publish(const Totals& totals, double progress) {
    const std::shared_ptr<Snapshot> snapshot = snapshot_of(totals, progress);
    snapshot->frame = run_.frames++;
    result_.totals = totals;
    if (sinks_->live != nullptr) sinks_->live->frame(snapshot);
    if (const auto reason = sinks_->frame(snapshot)) {
        result_.verdict = RunVerdict::sink_failed;
        result_.outcome = "stopped";
        result_.message = *reason;
        return Next::stop;
    }
    return Next::go_on;
}

Engine::Next Engine::between_steps(double progress, const std::function<double()>& next_limit_s) {
    if (sinks_->progress)
        sinks_->progress({run_.state.time_s, run_.diagnostics.dt_s, run_.stage,
                          static_cast<int>(scene_.stages.size()),
                          name_of(scene_.stages[idx(run_.stage)].kind), progress,
                          run_.diagnostics.steps});
    const double now_s = wall_clock_s();
    const bool limit_met =
        options_.wall_limit_s > 0.0 && now_s - started_wall_s_ >= options_.wall_limit_s;
    const bool goes_on = watcher_goes_on(next_limit_s);
    const bool is_stopped = !goes_on || stop_->load();
    if (is_stopped || limit_met) {
        write_checkpoint();
        result_.verdict = is_stopped ? RunVerdict::stopped : RunVerdict::time_limit;
        result_.outcome = is_stopped ? "stopped" : "time limit";
        return Next::stop;
    }
    if (now_s - checkpointed_wall_s_ >= options_.checkpoint_every_wall_s) write_checkpoint();
    return Next::go_on;
}

void Engine::write_checkpoint() {
    if (sinks_->checkpoint) sinks_->checkpoint(save(run_));
    checkpointed_wall_s_ = wall_clock_s();
}

}  // namespace spheroscope
