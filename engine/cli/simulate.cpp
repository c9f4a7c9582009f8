#include "engine/cli/simulate.hpp"

#include "engine/cli/interrupt.hpp"
#include "engine/cli/progress.hpp"
#include "engine/cli/totals_text.hpp"
#include "engine/cli/version.hpp"
#include "engine/run/channels.hpp"
#include "engine/store/checkpoint_file.hpp"
#include "engine/store/run_file.hpp"
#include "engine/store/xdmf.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include <condition_variable>
#include <filesystem>
#include <limits>
#include <mutex>
#include <optional>
#include <thread>

namespace spheroscope::cli {
namespace {

namespace fs = std::filesystem;

/// Frames that the store may be behind the engine.
constexpr int k_queue_capacity = 8;

/// The store's thread: writes every frame, and tells how many are on the disk. HDF5 is not thread-safe, so
/// whoever else wants to use it (the checkpoint) holds the same lock.
class StoreThread {
  public:
    StoreThread(RunFileWriter writer, FrameQueue::Reader reader)
        : writer_(std::move(writer)), n_written_(writer_.n_frames()),
          thread_([this, r = std::move(reader)]() mutable { write_all(r); }) {}
    ~StoreThread() { join(); }
    StoreThread(const StoreThread&) = delete;
    StoreThread& operator=(const StoreThread&) = delete;

    void join() {
        if (thread_.joinable()) thread_.join();
    }
    /// Waits for `n_frames` frames on the disk, then calls f with HDF5 to itself. False: the store failed.
    template <class F> bool when_written(int n_frames, const F& f) {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return n_written_ >= n_frames || has_failed_; });
        if (has_failed_) return false;
        f();
        return true;
    }
    /// After join().
    void finish(const RunEnd& end) { writer_.finish(end); }
    [[nodiscard]] bool has_failed() const { return has_failed_; }
    [[nodiscard]] SnapshotPtr last() const { return last_; }

  private:
    void write_all(FrameQueue::Reader& reader) {
        while (SnapshotPtr frame = reader.next()) {
            const std::unique_lock lock(mutex_);
            try {
                writer_.write(*frame);
                ++n_written_;
                last_ = std::move(frame);
            } catch (const Error& error) {
                has_failed_ = true;
                reader.fail(error.what());
                changed_.notify_all();
                return;
            }
            changed_.notify_all();
        }
    }

    RunFileWriter writer_;
    int n_written_;
    bool has_failed_ = false;
    SnapshotPtr last_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::thread thread_;  // last: it starts when all else is there
};

/// Cells of a frame of an earlier run, for `arrangement = "file"`.
std::optional<GivenCells> given_cells(const scene::Scene& scene) {
    if (scene.cells.arrangement != scene::Arrangement::file) return {};
    const fs::path path = fs::path(scene.file).parent_path() / scene.cells.file;
    const RunFileReader reader(path.string());
    const int frame = scene.cells.frame < 0 ? reader.n_frames() - 1 : scene.cells.frame;
    const SnapshotPtr snapshot = reader.frame(frame);
    GivenCells given;
    given.n_nodes = reader.header()->topology->n_nodes();
    for (const float r : reader.header()->radius_um) given.radius_um.push_back(double{r});
    for (std::size_t i = 0; i + 2 < snapshot->x_um.size(); i += 3)
        given.x_um.emplace_back(double{snapshot->x_um[i]}, double{snapshot->x_um[i + 1]},
                                double{snapshot->x_um[i + 2]});
    return given;
}

/// The checkpoint to go on from; none: begin anew. Throws if that would overwrite an unfinished run.
std::optional<RunState> start_point(const RunPlace& place, bool resume, bool overwrite) {
    const bool has_checkpoint = fs::exists(checkpoint_path(place.run_file())) ||
                                fs::exists(older_checkpoint_path(place.run_file()));
    const bool has_run = fs::exists(place.run_file());
    if (resume && has_checkpoint) {
        const LoadedCheckpoint loaded = read_newest_checkpoint(place.run_file());
        if (!loaded.note.empty()) spdlog::warn("{}", loaded.note);
        return load_run_state(loaded.data);
    }
    if (resume && has_run)
        throw Error(place.run_file() + ": there is no checkpoint to go on from",
                    "begin anew with --overwrite");
    if (has_run && !overwrite && has_checkpoint) {
        const RunFileReader reader(place.run_file());
        if (!reader.is_complete())
            throw Error(place.run_file() + ": an unfinished run is there",
                        "--resume goes on with it, --overwrite begins anew, -o writes elsewhere");
    }
    return {};
}

ExitCode exit_code(const RunResult& result, const std::vector<Expectation>& expectations) {
    switch (result.verdict) {
    case RunVerdict::finished:
        for (const Expectation& row : expectations)
            if (!row.met) return ExitCode::differs;
        return ExitCode::ok;
    case RunVerdict::stopped:
        return interrupt_signal() == SIGTERM ? ExitCode::terminated : ExitCode::interrupted;
    case RunVerdict::sink_failed: return ExitCode::usage;
    case RunVerdict::cap:
    case RunVerdict::time_limit:
    case RunVerdict::unstable: return ExitCode::not_converged;
    }
    return ExitCode::internal;
}

}  // namespace

RunPlace run_place(const std::string& scene_file, const CommonOptions& options) {
    if (!options.output.empty()) return {options.output};
    return {"out/" + fs::path(scene_file).stem().string()};
}

SimulationSummary simulate(const scene::Scene& scene, const RunPlace& place,
                           const CommonOptions& options, bool overwrite,
                           const Invocation& invocation) {
    check_expectation_names(scene);
    EngineOptions engine_options;
    engine_options.threads = options.n_threads();
    engine_options.version = version_text();
    engine_options.command_line = invocation.command_line;
    engine_options.wall_limit_s = options.time_limit_s().value_or(0.0);
    Engine engine(scene, engine_options, given_cells(scene));

    std::error_code failed;
    fs::create_directories(place.folder, failed);
    if (failed)
        throw Error(place.folder + ": cannot make this folder (" + failed.message() + ")",
                    "choose another one with -o");
    const std::optional<RunState> start = start_point(place, options.resume, overwrite);
    if (start) engine.resume(*start);
    else remove_checkpoints(place.run_file());

    const InterruptGuard interrupts;
    FrameQueue queue(k_queue_capacity);
    StoreThread store(start ? RunFileWriter::append(place.run_file(), *engine.header(), start->frames)
                            : RunFileWriter::create(place.run_file(), *engine.header(),
                                                    RunFileWriter::Existing::replace),
                      queue.add_reader("store"));
    Progress progress(progress_style(options.quiet));
    EngineSinks sinks;
    sinks.frame = [&](SnapshotPtr frame) { return queue.push(std::move(frame)); };
    sinks.checkpoint = [&](const CheckpointData& data) {
        store.when_written(engine.state().frames,
                           [&] { write_checkpoint(place.run_file(), data); });
    };
    sinks.progress = [&](const RunProgress& p) {
        progress.update({std::string(p.stage_name), p.stage_progress, p.time_s, p.dt_s});
    };

    SimulationSummary summary;
    std::optional<Error> trouble;
    std::thread engine_thread([&] {
        try {
            summary.result = engine.run(sinks, interrupts.stop());
        } catch (const Error& error) {
            trouble = error;
        }
        queue.close();
    });
    engine_thread.join();
    store.join();
    progress.clear();
    if (trouble) throw *trouble;
    // The last frame may fail after the last push.
    if (const auto reason = queue.failure(); reason && summary.result.message.empty()) {
        summary.result.verdict = RunVerdict::sink_failed;
        summary.result.outcome = "stopped";
        summary.result.message = *reason;
    }
    if (!store.has_failed()) {
        const bool over = summary.result.verdict == RunVerdict::finished ||
                          summary.result.verdict == RunVerdict::cap;
        store.finish({over, summary.result.outcome, summary.result.wall_s});
        write_xdmf(RunFileReader(place.run_file()));
        if (over && store.last())
            summary.expectations = check_expectations(scene, *store.last());
    }
    summary.code = exit_code(summary.result, summary.expectations);
    return summary;
}

std::string summary_text(const SimulationSummary& summary, const RunPlace& place) {
    const RunResult& r = summary.result;
    std::string text = fmt::format("outcome              {}\n", r.outcome);
    if (!r.message.empty()) text += fmt::format("because              {}\n", r.message);
    text += fmt::format("model time           {:.4g} s\nwall time            {}\nframes               {}\n",
                        r.time_s, duration_text(r.wall_s), r.frames);
    text += fmt::format("steps                {} ({} rejected)\n", r.work.steps,
                        r.work.rejected_steps);
    text += totals_text(r.totals);
    for (const Expectation& row : summary.expectations)
        text += fmt::format("expect {:<22} {} in [{:.6g}, {:.6g}] {}: {}\n", row.measure,
                            fmt::format("{:.6g}", row.value), row.min, row.max, row.unit,
                            row.met ? "met" : "NOT MET");
    text += fmt::format("state hash           {:016x}\nwritten to           {}\n", r.state_hash,
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
            {"wall_s", r.wall_s},
            {"frames", r.frames},
            {"totals", totals_json(r.totals)},
            {"work", work_json(r.work)},
            {"expectations", expectations},
            {"state_hash", fmt::format("{:016x}", r.state_hash)}};
}

}  // namespace spheroscope::cli
