#pragma once

#include "engine/cli/simulate.hpp"
#include "engine/inspect/contact_history.hpp"
#include "viewer/frames.hpp"
#include "viewer/model/kept_looks.hpp"
#include "viewer/model/live_channel.hpp"

#include <atomic>
#include <chrono>
#include <cstddef>
#include <exception>
#include <optional>
#include <thread>

namespace spheroscope::viewer {

/// A run that goes on while it is looked at: simulate() in a thread of its own, which writes the
/// run's file as without a panel. The newest k_kept_bytes of frames stay in memory for steps back.
class LiveRun final : public Frames {
  public:
    static constexpr std::size_t k_kept_bytes = std::size_t{1} << 30U;

    struct Begin {
        bool overwrite = false;  ///< an unfinished run that is there
        bool paused = false;
    };
    /// Waits for the engine to begin. Throws what simulate() throws before that. `on_news` is
    /// called in the engine's thread.
    LiveRun(const scene::Scene& scene, const cli::RunPlace& place,
            const cli::CommonOptions& options, Begin begin, const cli::Invocation& invocation,
            std::function<void()> on_news);
    /// Ends a run that is not over, with a checkpoint.
    ~LiveRun() override;

    [[nodiscard]] std::shared_ptr<const RunHeader> header() const override { return header_; }
    [[nodiscard]] std::vector<double> take_new_times() override;
    [[nodiscard]] SnapshotPtr frame(int number) override;
    [[nodiscard]] RunSurvey survey() override { return *survey_; }
    [[nodiscard]] int n_surveyed() override { return survey_->n_frames(); }
    /// Of frames that are kept; a few milliseconds for each, a few frames in each call of
    /// contact_history().
    void watch_contact(std::optional<inspect::ContactKey> key) override;
    [[nodiscard]] ContactRows contact_history() override;
    [[nodiscard]] std::string contact_failure() override { return contact_failure_; }
    [[nodiscard]] std::string failure() override { return failure_; }

    [[nodiscard]] LiveChannel& channel() { return channel_; }
    /// Takes the newest look from the engine, which may then make another one.
    void take_look();
    /// States between frames; the newest one only where it is newer than all frames.
    [[nodiscard]] const KeptLooks& looks() const { return looks_; }
    [[nodiscard]] SnapshotPtr newest_look() const;
    [[nodiscard]] bool is_over() const { return is_over_.load(); }
    /// "the run is over: unstable: the contact ..."; only when it is over.
    [[nodiscard]] std::string end_text() const;
    /// The scene with the changes so far.
    [[nodiscard]] const scene::Scene& scene_now();

    /// Stops the run if it is not over and waits for its end. Throws what simulate() threw.
    [[nodiscard]] cli::SimulationSummary finish();

  private:
    const scene::Scene scene_;
    scene::Scene scene_now_;
    std::size_t n_changes_ = 0;  // that are in scene_now_
    LiveChannel channel_;
    std::shared_ptr<const RunHeader> header_;
    std::optional<RunSurvey> survey_;
    std::vector<SnapshotPtr> frames_;  // nullptr: no longer kept
    std::size_t first_kept_ = 0, kept_bytes_ = 0;
    KeptLooks looks_;
    std::string failure_;
    std::unique_ptr<inspect::ContactHistorian> historian_;
    std::vector<inspect::ContactSummary> contact_rows_;
    ContactRows contact_history_;  // contact_rows_ as they were handed over last
    std::string contact_failure_;
    std::chrono::steady_clock::time_point told_at_{};
    std::size_t n_told_ = 0;  // frames that the historian has seen, or can no longer see

    std::atomic<bool> is_over_{false};
    std::optional<cli::SimulationSummary> summary_;  // after is_over_
    std::exception_ptr trouble_;                     // after is_over_
    std::thread thread_;
};

}  // namespace spheroscope::viewer
