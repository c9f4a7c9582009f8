// One run from top to bottom: stages one after another; in a stage, steps to the next output; at an
// output, measures and a snapshot. Everything that decides what comes next is in RunState, so a run
// that goes on from a checkpoint does the same steps as one that was never stopped.

#include "engine/run/engine.hpp"

#include "engine/base/index.hpp"
#include "engine/contact/simd_target.hpp"
#include "engine/forces/in_plane_elasticity.hpp"
#include "engine/run/health.hpp"
#include "engine/run/snapshot_maker.hpp"
#include "engine/stages/choices.hpp"

#include <algorithm>
#include <chrono>
#include <limits>

namespace spheroscope {
namespace {

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
    run_.approach.forget_step();
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
        next = stage.kind == scene::StageKind::anneal ? anneal(stage) : advance(*make_stage(stage));
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

StageContext Engine::stage_context() { return {*system_, run_.state, run_.memory}; }

Engine::Next Engine::advance(const Stage& stage) {
    if (!run_.stage_has_begun && begin_stage(stage) == Next::stop) return Next::stop;
    const std::function<double()> next_limit_s = [&] {
        return std::min(next_output_s(stage.parameters()), stage.latest_end_s(stage_context()));
    };
    StageEnd end = StageEnd::none;
    while (end == StageEnd::none) {
        apply_changes();  // may make another system
        if (take_step(next_limit_s()) == Next::stop) return Next::stop;
        StageContext context = stage_context();
        end = stage.after_step(context);
        if ((end != StageEnd::none || measurement_is_due(stage.parameters())) &&
            measure_stage(stage, end) == Next::stop)
            return Next::stop;
        if (end == StageEnd::none) {
            const double progress = stage.progress(context);
            show_look(progress);
            if (between_steps(progress, next_limit_s) == Next::stop) return Next::stop;
        }
    }
    StageContext context = stage_context();
    stage.end(context);
    finish_stage(end);
    return Next::go_on;
}

Engine::Next Engine::begin_stage(const Stage& stage) {
    refine_to(stage.parameters().nodes);
    run_.memory.start_s = run_.state.time_s;
    // A relaxation after another one on the same mesh goes on looking at the same motion.
    if (!goes_on_relaxing()) run_.memory.samples.clear();
    StageContext context = stage_context();
    stage.begin(context);
    run_.stage_has_begun = true;
    run_.has_energy = false;
    const bool start_is_a_frame = run_.frames == 0 && stage.parameters().every_s > 0.0;
    return start_is_a_frame ? publish(measure(), 0.0) : Next::go_on;
}

Engine::Next Engine::take_step(double limit_s) {
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
    d.dt_s = step.dt_s;
    d.force_residual_nN = step.force_rms_nN;
    d.force_balance_nN = step.force_sum_nN;
    d.step_error_um = step.error_um;
    run_.approach.after_step(step.dt_s);
    run_.dissipation_nN_um_per_s = step.dissipation_nN_um_per_s;
    run_.dissipated_fJ += step.dt_s * step.dissipation_nN_um_per_s;
    run_.driven_fJ += step.dt_s * step.drive_power_nN_um_per_s;
    return Next::go_on;
}

bool Engine::measurement_is_due(const scene::Stage& stage) const {
    return run_.state.time_s >= next_output_s(stage) ||
           (checks_by_steps_in(stage) && run_.diagnostics.steps % k_check_every_steps == 0);
}

Engine::Next Engine::measure_stage(const Stage& stage, StageEnd& end) {
    if (run_.state.time_s >= next_output_s(stage.parameters())) ++run_.outputs_in_stage;
    const Totals totals = measure();
    run_.approach.after_measurement(run_.state.time_s, run_.state.v_um_per_s);
    StageContext context = stage_context();
    if (end == StageEnd::none || end == StageEnd::cap || end == StageEnd::done) {
        const StageEnd met = stage.after_measure(context, totals);
        if (met != StageEnd::none) end = met;
    }
    const bool is_output = stage.parameters().every_s > 0.0 || end != StageEnd::none;
    if (is_output && publish(totals, stage.progress(context)) == Next::stop) return Next::stop;
    // Overlapping beads leave overlapping cells, which part in a fraction of this time.
    if (run_.state.time_s >= k_parting_s && scene_.contact)
        if (const auto trouble =
                cells_inside_each_other(*system_, run_.state.x_um, scene_.contact->loc))
            return stop_unstable(run_.diagnostics.dt_s, *trouble);
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
