#pragma once

#include "engine/run/live_control.hpp"
#include "viewer/model/live_events.hpp"
#include "viewer/model/pace.hpp"

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

namespace spheroscope::viewer {

/// Between a panel and an engine that runs: frames, looks and what became of orders one way, orders
/// the other. The panel waits for the begin alone; the engine waits only in a pause.
class LiveChannel final : public LiveControl {
  public:
    /// `on_news` is called in the engine's thread.
    explicit LiveChannel(std::function<void()> on_news) : on_news_(std::move(on_news)) {}

    // The panel's side.
    void pause();
    void play();
    /// One step, then a pause.
    void step();
    /// Plays until something happens to what is watched, then a pause (viewer/model/live_events).
    void run_until_event(const Watched& watched);
    /// While held the engine makes no further step: the processors are for drawing then. Not a
    /// pause: nothing that is shown or asked for changes by it.
    void hold(bool is_held);
    /// Ends the run, with a checkpoint, also out of a pause.
    void stop();
    /// Replaces an order of the same key that the engine has not taken yet.
    void order(Change change);
    /// A pause, in which the engine says what its next step would go through (take_anatomy).
    void look_into_step(std::optional<NodeOfCell> node);
    [[nodiscard]] bool is_paused();
    /// Waits until the engine has begun and says what it is about, or has ended without: nullptr.
    [[nodiscard]] std::shared_ptr<const RunHeader> wait_for_header();
    [[nodiscard]] std::vector<SnapshotPtr> take_frames();
    /// The newest look, once.
    [[nodiscard]] SnapshotPtr take_look();
    /// The answer to look_into_step, once; nullptr: none yet.
    [[nodiscard]] std::shared_ptr<const StepAnatomy> take_anatomy();
    [[nodiscard]] std::vector<Change> changes();
    /// Why orders were refused, and which events have brought a pause: what was not taken yet, in
    /// order.
    [[nodiscard]] std::vector<std::string> take_messages();
    [[nodiscard]] Pace pace();

    // The engine's side.
    void begin(std::shared_ptr<const RunHeader> header) override;
    /// Nothing will come any more.
    void end();
    void frame(SnapshotPtr frame) override;
    [[nodiscard]] bool go_on(const std::atomic<bool>& stop) override;
    [[nodiscard]] std::optional<Question> take_question() override;
    void anatomy(std::shared_ptr<const StepAnatomy> answer) override;
    void refused_question(const std::string& reason) override;
    [[nodiscard]] bool wants_look() override;
    void look(SnapshotPtr now) override;
    [[nodiscard]] std::vector<Change> take_changes() override;
    void changed(const Change& change) override;
    void refused(const Change& change, const std::string& reason) override;

  private:
    /// With mutex_ held: what a state says about events and pace.
    void see(const SnapshotPtr& now);

    const std::function<void()> on_news_;
    std::mutex mutex_;
    std::condition_variable woken_;
    // guarded by mutex_
    bool is_paused_ = false, is_held_ = false, is_stopped_ = false, has_ended_ = false;
    int steps_left_ = 0;  // in a pause
    bool seeks_event_ = false;
    Watched watched_;
    std::shared_ptr<const RunHeader> header_;
    std::vector<SnapshotPtr> frames_;
    SnapshotPtr look_, seen_;
    std::chrono::steady_clock::time_point looked_at_{};
    bool look_is_due_ = false;  // after a step in a pause, whatever the panel has taken
    std::optional<Question> question_;
    std::shared_ptr<const StepAnatomy> anatomy_;
    std::vector<Change> ordered_, changes_;
    std::vector<std::string> messages_;
    Pace pace_;
};

}  // namespace spheroscope::viewer
