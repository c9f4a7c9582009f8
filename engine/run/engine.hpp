#pragma once

#include "engine/model/prolongation.hpp"
#include "engine/run/live_control.hpp"
#include "engine/run/run_state.hpp"
#include "engine/run/snapshot.hpp"
#include "engine/scene/scene.hpp"
#include "engine/solve/method.hpp"
#include "engine/stages/build.hpp"

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace spheroscope {

struct EngineOptions {
    int threads = 2;  ///< at most; small systems use fewer, with the same bits
    std::string version;
    std::string command_line;
    double checkpoint_every_wall_s = 10.0;
    double wall_limit_s = 0.0;         ///< stop with a checkpoint after this wall time; 0: no limit
    std::vector<Change> changes = {};  ///< to be made on the way, in the order of their times
};

/// For progress bars.
struct RunProgress {
    double time_s = 0.0;
    double dt_s = 0.0;
    int stage = 0;
    int n_stages = 0;
    std::string_view stage_name;
    double stage_progress = 0.0;  ///< 0..1, or NaN
    std::int64_t steps = 0;
};

/// Where frames and checkpoints go; both are called in the engine's thread. The engine knows no
/// files.
struct EngineSinks {
    /// Returns the reason if the frame could not be taken; then the run ends with it.
    std::function<std::optional<std::string>(SnapshotPtr)> frame;
    /// May throw Error; the run ends with it. Called only when all frames before it were taken.
    std::function<void(const CheckpointData&)> checkpoint;
    /// After every step, for progress bars; may be empty.
    std::function<void(const RunProgress&)> progress;
    /// Somebody who watches and changes the run; nullptr: nobody.
    LiveControl* live = nullptr;
    /// A change that the watcher has made took effect; to be kept with the run. May be empty.
    std::function<void(const Change&)> changed = {};
};

/// How a run ended.
enum class RunVerdict { finished, cap, stopped, time_limit, unstable, sink_failed };

struct RunResult {
    RunVerdict verdict = RunVerdict::finished;
    std::string outcome;  ///< "done", "rest", "stationary", "cap", "stopped", "unstable", ...
    std::string message;  ///< what went wrong, with term, cell and scene line; "" if nothing did
    double wall_s = 0.0;  ///< of this process
    Work work;
    Totals totals{};                   ///< of the last measurement
    std::vector<MeasureError> errors;  ///< of the end of a run that is over; else empty
    double time_s = 0.0;
    bool time_is_physical = true;  ///< false for a method that only looks for an end state
    int frames = 0;
    std::uint64_t state_hash = 0;
};

/// Runs a scene: the single owner and writer of State. Lives in one thread; others see its
/// snapshots.
class Engine {
  public:
    /// Throws Error for what only the engine can know: fields without their part of the model, an
    /// unknown method, given cells that do not fit.
    Engine(const scene::Scene& scene, const EngineOptions& options,
           const std::optional<GivenCells>& given = {});
    ~Engine();

    /// Goes on from a checkpoint. Before run().
    void resume(const RunState& run);

    [[nodiscard]] std::shared_ptr<const RunHeader> header() const { return header_; }
    [[nodiscard]] const RunState& state() const { return run_; }

    /// Runs to the end, or until `stop` becomes true (after the step in progress, with a
    /// checkpoint).
    [[nodiscard]] RunResult run(const EngineSinks& sinks, const std::atomic<bool>& stop);

  private:
    enum class Next { go_on, stop };
    /// Makes the system for cells of this mesh; forgets the one before.
    void use_mesh(int n_nodes);
    /// Carries the cells over to a finer mesh, if they are not on it yet.
    void refine_to(int n_nodes);
    [[nodiscard]] Next anneal(const scene::Stage& stage);
    /// Steps and measurements until the stage ends. It has parameters of its own: changes make the
    /// scene anew.
    [[nodiscard]] Next advance(const Stage& stage);
    [[nodiscard]] Next begin_stage(const Stage& stage);
    /// One step of the method, not beyond limit_s, with its share in the sums of the run.
    [[nodiscard]] Next take_step(double limit_s);
    /// An output or a check of this stage, after a step.
    [[nodiscard]] bool measurement_is_due(const scene::Stage& stage) const;
    /// Measures, publishes a frame where the stage has outputs or is over, and stops where cells
    /// are inside each other. Sets `end` where the stage finds in the measures that it is over.
    [[nodiscard]] Next measure_stage(const Stage& stage, StageEnd& end);
    /// For the system as it is now: a change makes another one.
    [[nodiscard]] StageContext stage_context();
    [[nodiscard]] Totals measure();
    [[nodiscard]] Next publish(const Totals& totals, double progress);
    /// The state as it was measured last, with its fields; its number is -1.
    [[nodiscard]] std::shared_ptr<Snapshot> snapshot_of(const Totals& totals, double progress);
    /// Shows the state to whoever watches, if a look is welcome, and leaves it as it is.
    void show_look(double progress);
    /// Changes that are due before the next step: those of the options, then those of the watcher.
    void apply_changes();
    /// Throws Error, with everything as it was.
    void make_change(const Change& change);
    /// Whether a stage without outputs of its own is looked at after so many steps, not seconds.
    [[nodiscard]] bool checks_by_steps_in(const scene::Stage& stage) const;
    /// Time of the next output or check, beyond which no step goes.
    [[nodiscard]] double next_output_s(const scene::Stage& stage) const;
    /// Reports progress, writes a checkpoint when one is due, obeys stop and the time limit.
    /// next_limit_s says how far the next step may go; empty while beads are packed.
    [[nodiscard]] Next between_steps(double progress,
                                     const std::function<double()>& next_limit_s = {});
    /// Waits in a pause, and answers questions; false: the run is to stop.
    [[nodiscard]] bool watcher_goes_on(const std::function<double()>& next_limit_s);
    /// Ends the run with its reason.
    [[nodiscard]] Next stop_unstable(double dt_s, const Trouble& trouble);
    /// What is said of the end of a run is what the last stage has found at its own end.
    void finish_stage(StageEnd end);
    [[nodiscard]] bool goes_on_relaxing() const;
    [[nodiscard]] std::vector<MeasureError> estimate_errors();
    /// Measures of the end state moved by this displacement [all nodes]; empty if there is none.
    [[nodiscard]] std::optional<Totals> totals_moved_by(std::span<const Vec3> displacement_um);
    void write_checkpoint();
    /// Pressures and stresses of the cells, which several measures read.
    void compute_cell_measures(const Configuration& at);
    /// What measures and frames read; the cells' as they were last computed.
    [[nodiscard]] MeasureInput measure_input(const Configuration& at) const;

    scene::Scene scene_;
    EngineOptions options_;
    std::shared_ptr<RunHeader> header_;
    std::unique_ptr<System> system_;
    Work earlier_work_;                      ///< of the systems on coarser meshes
    std::optional<Prolongation> to_frames_;  ///< from the system's mesh, if it is coarser
    std::unique_ptr<Method> method_;
    std::size_t n_changes_applied_ = 0;  // of options_.changes
    std::shared_ptr<const std::vector<Change>> changes_made_;
    std::vector<Vec3> held_force_nN_;       // [all nodes]; empty without [load.held]
    std::vector<double> spring_nN_per_um_;  // [n_edges], for measures
    std::vector<double> pressure_kPa_;      // [cells]
    std::vector<Mat3> cell_stress_kPa_;     // [cells]
    RunState run_;
    RunResult result_;
    const EngineSinks* sinks_ = nullptr;
    const std::atomic<bool>* stop_ = nullptr;
    double started_wall_s_ = 0.0, checkpointed_wall_s_ = 0.0;
};

}  // namespace spheroscope
