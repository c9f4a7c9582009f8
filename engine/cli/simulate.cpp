#include "engine/cli/simulate.hpp"

#include "engine/base/make_folder.hpp"
#include "engine/cli/accuracy_text.hpp"
#include "engine/cli/interrupt.hpp"
#include "engine/cli/log.hpp"
#include "engine/cli/progress.hpp"
#include "engine/cli/recorder.hpp"
#include "engine/cli/report_output.hpp"
#include "engine/cli/totals_text.hpp"
#include "engine/cli/version.hpp"
#include "engine/contact/simd_target.hpp"
#include "engine/run/companion.hpp"
#include "engine/scene/same_run.hpp"
#include "engine/stages/choices.hpp"
#include "engine/store/checkpoint_file.hpp"
#include "engine/store/held_load_file.hpp"
#include "engine/store/run_file.hpp"
#include "engine/store/xdmf.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <exception>
#include <filesystem>
#include <limits>
#include <optional>
#include <thread>

namespace spheroscope::cli {
namespace {

namespace fs = std::filesystem;

/// Where a run begins, and what becomes of a file that is there.
struct StartPoint {
    std::optional<RunState> state;  ///< of the newest checkpoint; none: the scene's own start
    bool continues_file = false;    ///< the file's frames before `state` are kept
    bool is_over = false;           ///< the file holds the finished run of this scene
};

StartPoint point_to_resume(const RunPlace& place, const scene::Scene& scene) {
    const std::string file = place.run_file();
    const bool has_checkpoint =
        fs::exists(checkpoint_path(file)) || fs::exists(older_checkpoint_path(file));
    if (!fs::exists(file)) {
        if (has_checkpoint)
            throw Error(file + ": there is a checkpoint, but the run that it belongs to is gone",
                        "without --resume the run begins anew");
        log_info(fmt::format("{}: there is nothing to go on from; the run begins", file));
        return {};
    }
    StartPoint start{.state = {}, .continues_file = true};
    const RunFileReader reader(file);
    if (reader.is_complete()) {
        if (!is_run_of(scene, *reader.header()))
            throw Error(file + ": this is the finished run of another scene or seed",
                        "--overwrite replaces it, -o writes elsewhere");
        start.is_over = true;
        return start;
    }
    if (has_checkpoint) {
        const LoadedCheckpoint loaded = read_newest_checkpoint(file);
        if (!loaded.note.empty()) log_warning(loaded.note);
        start.state = load_run_state(loaded.data);
    } else {
        log_info(fmt::format("{}: stopped before its first checkpoint; the run begins anew", file));
    }
    return start;
}

/// Whether the file is what the run would make again, byte for byte but for its times: a job that
/// is started twice does not throw away what the first one has made. Precondition: nothing that
/// check_nothing_is_lost refuses.
bool holds_this_run(const RunPlace& place, const RunHeader& wanted) {
    if (!fs::exists(place.run_file())) return false;
    const RunFileReader reader(place.run_file());
    const RunHeader& stored = *reader.header();
    return is_made_by_this_program(stored) && stored.resolved_scene == wanted.resolved_scene &&
           stored.contact_arithmetic == wanted.contact_arithmetic;
}

/// Throws if the run cannot begin there, or something would be lost.
StartPoint start_point(const RunPlace& place, const scene::Scene& scene, const RunHeader& wanted,
                       const std::vector<Change>& changes, bool resume, bool overwrite) {
    if (resume && overwrite)
        throw Error("--resume and --overwrite exclude each other",
                    "--resume goes on with what is there, --overwrite begins anew");
    if (resume) return point_to_resume(place, scene);
    if (overwrite) return {};
    check_nothing_is_lost(place, scene, changes);
    return {.state = {}, .is_over = holds_this_run(place, wanted)};
}

bool is_over(RunVerdict verdict) {
    return verdict == RunVerdict::finished || verdict == RunVerdict::cap;
}

ExitCode exit_code(const SimulationSummary& summary, ExitCode store_failure) {
    switch (summary.result.verdict) {
    case RunVerdict::finished:
        for (const Expectation& row : summary.expectations)
            if (!row.met) return ExitCode::differs;
        return ExitCode::ok;
    case RunVerdict::stopped: return code_after_signal(ExitCode::interrupted);
    case RunVerdict::sink_failed: return store_failure;
    case RunVerdict::cap:
    case RunVerdict::time_limit:
    case RunVerdict::unstable: return ExitCode::not_converged;
    }
    return ExitCode::internal;
}

/// What the last frame of a file tells about a run of which this process has written no frame.
void take_from_file(const RunFileReader& reader, const scene::Scene& scene,
                    SimulationSummary& summary) {
    if (reader.n_frames() == 0) return;
    const SnapshotPtr last = reader.frame(reader.n_frames() - 1);
    summary.result.totals = last->totals;
    summary.result.time_s = last->time_s;
    summary.result.work.steps = last->diagnostics.steps;
    summary.result.work.rejected_steps = last->diagnostics.rejected_steps;
    if (is_over(summary.result.verdict)) summary.expectations = check_expectations(scene, *last);
}

/// The same run with half the steps, without frames. If it comes to no end the error of the time
/// steps stays unknown, and the log says why.
void measure_time_error(const scene::Scene& scene, const EngineOptions& options,
                        const std::atomic<bool>& stop, RunResult& result) {
    const MethodRow& method = chosen_method(scene);
    if (!method.moves_in_time() || result.work.steps == 0) return;
    log_info("once more with half the steps, for the error of the time steps");
    EngineOptions once = options;
    once.wall_limit_s = 0.0;
    Engine engine(with_half_steps(scene, result.time_s, result.work.steps), once,
                  given_cells(scene));
    EngineSinks sinks;
    sinks.frame = [](const SnapshotPtr&) { return std::optional<std::string>(); };
    const RunResult other = engine.run(sinks, stop);
    result.wall_s += other.wall_s;
    if (is_over(other.verdict))
        set_time_error(result.errors, other.totals, method.order);
    else
        log_warning(
            fmt::format("the run with half the steps ended as '{}': its error is not measured {}",
                        other.outcome, other.message));
}

/// The same run, without frames, on the next coarser mesh, and on the one below that where there is
/// one. If one comes to no end the error of the mesh stays unknown, and the log says why.
void estimate_mesh_error(const scene::Scene& scene, const EngineOptions& options,
                         const std::atomic<bool>& stop, RunResult& result) {
    std::vector<Totals> ends;
    // Each subdivision makes 4 n - 6 nodes of n, the first one 42.
    for (int nodes = (scene.cells.nodes + 6) / 4; nodes >= 42 && ends.size() < 2;
         nodes = (nodes + 6) / 4) {
        scene::Scene coarser = scene::on_mesh(scene, nodes);
        for (scene::Stage& stage : coarser.stages) stage.frames = 0;
        log_info(fmt::format("once more with {} nodes per cell, for the error of the mesh", nodes));
        EngineOptions once = options;
        once.wall_limit_s = 0.0;
        Engine engine(coarser, once);
        EngineSinks sinks;
        sinks.frame = [](const SnapshotPtr&) { return std::optional<std::string>(); };
        const RunResult other = engine.run(sinks, stop);
        result.wall_s += other.wall_s;
        if (!is_over(other.verdict)) {
            log_warning(fmt::format("the run on {} nodes ended as '{}': no error of the mesh {}",
                                    nodes, other.outcome, other.message));
            return;
        }
        ends.push_back(other.totals);
    }
    add_mesh_error(result.errors, ends);
}

SimulationSummary summary_of_finished(const RunPlace& place, const scene::Scene& scene) {
    const RunFileReader reader(place.run_file());
    SimulationSummary summary;
    RunResult& result = summary.result;
    result.outcome = reader.outcome();
    result.verdict =
        result.outcome == name_of(StageEnd::cap) ? RunVerdict::cap : RunVerdict::finished;
    result.wall_s = reader.end().wall_time_s;
    result.frames = reader.n_frames();
    result.errors = reader.end().errors;
    summary.state_hash = reader.end().state_hash;
    take_from_file(reader, scene, summary);
    summary.code = exit_code(summary, ExitCode::ok);
    return summary;
}

EngineOptions engine_options_of(const CommonOptions& options, const RunPlace& place,
                                const std::vector<Change>& changes, const Invocation& invocation) {
    if (!options.simd.empty() && !use_simd_target(options.simd))
        throw Error(fmt::format("--simd wants one of {}, got '{}'", fmt::join(simd_targets(), ", "),
                                options.simd),
                    "leave it out for the best");
    EngineOptions result;
    result.threads = options.n_threads();
    result.version = version_text();
    result.command_line = invocation.command_line;
    result.wall_limit_s = options.time_limit_s().value_or(0.0);
    result.checkpoint_every_wall_s =
        options.checkpoint_every_s().value_or(result.checkpoint_every_wall_s);
    result.changes = changes;
    if (options.resume && fs::exists(place.run_file()))
        result.changes = RunFileReader(place.run_file()).changes();
    return result;
}

/// Runs the engine in a thread of its own, to its end or to a signal.
RunResult run_in_thread(Engine& engine, const EngineSinks& sinks, const std::atomic<bool>& stop) {
    RunResult result;
    std::exception_ptr trouble;
    std::thread thread([&] {
        try {
            result = engine.run(sinks, stop);
        } catch (...) {
            trouble = std::current_exception();
        }
    });
    thread.join();
    if (trouble) std::rethrow_exception(trouble);
    return result;
}

void show_progress(Progress& progress, const RunProgress& p) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    progress.update(
        {std::string(p.stage_name), p.stage_progress, p.time_s, p.dt_s > 0.0 ? p.dt_s : none});
}

/// Measures the errors that the scene asks for, ends the file, and judges the end.
void finish_file(const scene::Scene& scene, const EngineOptions& options,
                 const std::atomic<bool>& stop, const RunPlace& place, StoreThread& store,
                 SimulationSummary& summary) {
    RunResult& result = summary.result;
    if (is_over(result.verdict) && scene.measures.time_error)
        measure_time_error(scene, options, stop, result);
    if (is_over(result.verdict) && scene.measures.mesh_error)
        estimate_mesh_error(scene, options, stop, result);
    RunEnd end{is_over(result.verdict), result.outcome, result.wall_s, result.errors};
    if (end.is_complete) end.state_hash = result.state_hash;
    store.finish(end);
    const RunFileReader reader(place.run_file());
    write_xdmf(reader);
    if (!store.last())
        take_from_file(reader, scene, summary);
    else if (is_over(result.verdict))
        summary.expectations = check_expectations(scene, *store.last());
}

}  // namespace

void refuse_cells_beside_a_scene(const scene::Scene& scene, const std::string& where,
                                 const std::string& hint) {
    if (scene.cells.arrangement != scene::Arrangement::file ||
        fs::path(scene.cells.file).is_absolute())
        return;
    throw Error(fmt::format("{}: its run began with the cells of {}, beside a scene that is not "
                            "known here",
                            where, scene.cells.file),
                hint);
}

std::optional<GivenCells> given_cells(const scene::Scene& scene) {
    if (scene.cells.arrangement != scene::Arrangement::file) return {};
    const fs::path path = fs::path(scene.file).parent_path() / scene.cells.file;
    try {
        const RunFileReader reader(path.string());
        const int frame = scene.cells.frame < 0 ? reader.n_frames() - 1 : scene.cells.frame;
        const SnapshotPtr snapshot = reader.frame(frame);
        GivenCells given;
        given.n_nodes = reader.header()->topology->n_nodes();
        for (const float r : reader.header()->radius_um) given.radius_um.push_back(double{r});
        for (std::size_t i = 0; i + 2 < snapshot->x_um.size(); i += 3)
            given.x_um.emplace_back(double{snapshot->x_um[i]}, double{snapshot->x_um[i + 1]},
                                    double{snapshot->x_um[i + 2]});
        if (scene.held) given.held = read_held_load(path.string());
        return given;
    } catch (const Error& error) {
        throw Error(scene.cells.loc,
                    "cells.file: no cells can be had from this run\n  " + std::string(error.what()),
                    "", error.code());
    }
}

bool is_made_by_this_program(const RunHeader& stored) {
    const std::string version = version_text();
    return stored.version == version && version.find("+changes") == std::string::npos;
}

bool is_run_of(const scene::Scene& scene, const RunHeader& stored) {
    return scene::is_same_run(stored.resolved_scene, scene.resolved_toml);
}

void check_nothing_is_lost(const RunPlace& place, const scene::Scene& scene,
                           const std::vector<Change>& changes) {
    if (!fs::exists(place.run_file())) return;
    const RunFileReader reader(place.run_file());
    const auto refuse = [&](const std::string& what, const std::string& hint) {
        throw Error(place.run_file() + ": " + what + " is there", hint + ", -o writes elsewhere");
    };
    if (!reader.is_complete())
        refuse("an unfinished run", "--resume goes on with it, --overwrite begins anew");
    if (!is_run_of(scene, *reader.header()))
        refuse("the finished run of another scene or seed", "--overwrite replaces it");
    if (reader.changes() != changes)
        refuse("a finished run that was changed on its way", "--overwrite replaces it");
}

RunPlace run_place(const std::string& scene_file, const CommonOptions& options) {
    if (!options.output.empty()) return {options.output};
    return {"out/" + fs::path(scene_file).stem().string()};
}

SimulationSummary simulate(const scene::Scene& scene, const RunPlace& place,
                           const CommonOptions& options, bool overwrite,
                           const Invocation& invocation, const std::vector<Change>& changes,
                           LiveControl* live) {
    check_expectation_names(scene);
    EngineOptions engine_options = engine_options_of(options, place, changes, invocation);
    Engine engine(scene, engine_options, given_cells(scene));

    make_folder(place.folder);
    const StartPoint start =
        start_point(place, scene, *engine.header(), changes, options.resume, overwrite);
    if (start.state) engine.resume(*start.state);
    if (start.is_over) {
        log_info(fmt::format("{}: this run is finished; nothing is left to do (--overwrite makes "
                             "it again)",
                             place.run_file()));
        return summary_of_finished(place, scene);
    }
    if (!start.continues_file) remove_checkpoints(place.run_file());

    const InterruptGuard interrupts;
    Recorder recorder(engine, place.run_file(), start.continues_file, engine_options.changes);
    Progress progress(progress_style(options.quiet));
    EngineSinks sinks;
    sinks.live = live;
    sinks.progress = [&](const RunProgress& p) { show_progress(progress, p); };
    recorder.add_to(sinks);

    SimulationSummary summary;
    summary.contact_arithmetic = engine.header()->contact_arithmetic;
    summary.result = run_in_thread(engine, sinks, interrupts.stop());
    recorder.end(summary.result);
    progress.clear();
    summary.state_hash = summary.result.state_hash;
    engine_options.changes = recorder.changes();
    StoreThread& store = recorder.store();
    if (!store.has_failed())
        finish_file(scene, engine_options, interrupts.stop(), place, store, summary);
    if (summary.result.verdict == RunVerdict::unstable &&
        fs::exists(checkpoint_path(place.run_file())))
        summary.result.message +=
            "\n  hint: the last good state is in " + checkpoint_path(place.run_file());
    summary.code = exit_code(summary, store.failure());
    return summary;
}

std::string summary_text(const SimulationSummary& summary, const RunPlace& place) {
    const RunResult& r = summary.result;
    std::string text = fmt::format("outcome              {}\n", r.outcome);
    if (!r.message.empty()) text += fmt::format("because              {}\n", r.message);
    text += fmt::format(
        "model time           {:.4g} s{}\nwall time            {}\nframes               {}\n",
        r.time_s, r.time_is_physical ? "" : " (not physical: only the end state means something)",
        duration_text(r.wall_s), r.frames);
    text +=
        fmt::format("steps                {} ({} rejected)\n", r.work.steps, r.work.rejected_steps);
    if (!summary.contact_arithmetic.empty())
        text += fmt::format("contact kernel       {}\n", summary.contact_arithmetic);
    text += totals_text(r.totals, r.errors);
    text += accuracy_text(r.errors, r.wall_s);
    for (const Expectation& row : summary.expectations) {
        const bool is_shown = is_resolved(*find_total(row.measure), r.errors);
        text += fmt::format("expect {:<22} {} in [{:.6g}, {:.6g}] {}: {}\n", row.measure,
                            is_shown ? fmt::format("{:.6g}", row.value) : "(not resolved)", row.min,
                            row.max, row.unit, row.met ? "met" : "NOT MET");
    }
    text += fmt::format("state hash           {}\nwritten to           {}\n",
                        summary.state_hash
                            ? hash_text(*summary.state_hash)
                            : std::string("not known: an earlier version wrote the file"),
                        place.run_file());
    return text;
}

nlohmann::json summary_json(const SimulationSummary& summary, const RunPlace& place) {
    const RunResult& r = summary.result;
    nlohmann::json expectations = nlohmann::json::array();
    for (const Expectation& row : summary.expectations)
        expectations.push_back({{"measure", row.measure},
                                {"value", row.value},
                                {"min", row.min},
                                {"max", row.max},
                                {"met", row.met}});
    return {{"outcome", r.outcome},
            {"message", r.message},
            {"exit_code", static_cast<int>(summary.code)},
            {"file", place.run_file()},
            {"time_s", r.time_s},
            {"time_is_physical", r.time_is_physical},
            {"wall_s", r.wall_s},
            {"frames", r.frames},
            {"totals", totals_json(r.totals)},
            {"not_resolved", not_resolved_json(r.errors)},
            {"errors", accuracy_json(r.errors)},
            {"work", work_json(r.work)},
            {"contact_arithmetic", summary.contact_arithmetic},
            {"expectations", expectations},
            {"state_hash", summary.state_hash ? nlohmann::json(hash_text(*summary.state_hash))
                                              : nlohmann::json()}};
}

}  // namespace spheroscope::cli
