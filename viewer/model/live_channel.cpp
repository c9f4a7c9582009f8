#include "viewer/model/live_channel.hpp"

#include <utility>

namespace spheroscope::viewer {
namespace {

/// A signal sets an atomic and wakes nobody: so a pause looks at it now and then.
constexpr std::chrono::milliseconds k_signal_latency{50};

/// A look costs the engine a measurement: more of them than pictures can be drawn are of no use.
constexpr std::chrono::milliseconds k_look_every{60};

}  // namespace

void LiveChannel::pause() {
    const std::lock_guard lock(mutex_);
    is_paused_ = true;
    seeks_event_ = false;
    look_is_due_ = true;
}

void LiveChannel::play() {
    const std::lock_guard lock(mutex_);
    is_paused_ = seeks_event_ = false;
    steps_left_ = 0;
    woken_.notify_all();
}

void LiveChannel::step() {
    const std::lock_guard lock(mutex_);
    is_paused_ = true;
    seeks_event_ = false;
    ++steps_left_;
    woken_.notify_all();
}

void LiveChannel::run_until_event(const Watched& watched) {
    const std::lock_guard lock(mutex_);
    is_paused_ = false;
    steps_left_ = 0;
    seeks_event_ = true;
    watched_ = watched;
    woken_.notify_all();
}

void LiveChannel::look_into_step(std::optional<NodeOfCell> node) {
    const std::lock_guard lock(mutex_);
    is_paused_ = true;
    seeks_event_ = false;
    question_ = Question{node};
    woken_.notify_all();
}

void LiveChannel::hold(bool is_held) {
    const std::lock_guard lock(mutex_);
    if (is_held_ == is_held) return;
    is_held_ = is_held;
    woken_.notify_all();
}

void LiveChannel::stop() {
    const std::lock_guard lock(mutex_);
    is_stopped_ = true;
    woken_.notify_all();
}

void LiveChannel::order(Change change) {
    const std::lock_guard lock(mutex_);
    std::erase_if(ordered_, [&](const Change& earlier) { return earlier.key == change.key; });
    ordered_.push_back(std::move(change));
}

bool LiveChannel::is_paused() {
    const std::lock_guard lock(mutex_);
    return is_paused_;
}

std::shared_ptr<const RunHeader> LiveChannel::wait_for_header() {
    std::unique_lock lock(mutex_);
    woken_.wait(lock, [&] { return header_ != nullptr || has_ended_; });
    return header_;
}

std::vector<SnapshotPtr> LiveChannel::take_frames() {
    const std::lock_guard lock(mutex_);
    return std::exchange(frames_, {});
}

SnapshotPtr LiveChannel::take_look() {
    const std::lock_guard lock(mutex_);
    return std::exchange(look_, nullptr);
}

std::shared_ptr<const StepAnatomy> LiveChannel::take_anatomy() {
    const std::lock_guard lock(mutex_);
    return std::exchange(anatomy_, nullptr);
}

std::vector<Change> LiveChannel::changes() {
    const std::lock_guard lock(mutex_);
    return changes_;
}

std::vector<std::string> LiveChannel::take_messages() {
    const std::lock_guard lock(mutex_);
    return std::exchange(messages_, {});
}

Pace LiveChannel::pace() {
    const std::lock_guard lock(mutex_);
    return pace_;
}

void LiveChannel::begin(std::shared_ptr<const RunHeader> header) {
    const std::lock_guard lock(mutex_);
    header_ = std::move(header);
    woken_.notify_all();
}

void LiveChannel::end() {
    const std::lock_guard lock(mutex_);
    has_ended_ = true;
    woken_.notify_all();
}

void LiveChannel::frame(SnapshotPtr frame) {
    {
        const std::lock_guard lock(mutex_);
        see(frame);
        frames_.push_back(std::move(frame));
    }
    on_news_();
}

bool LiveChannel::go_on(const std::atomic<bool>& stop) {
    std::unique_lock lock(mutex_);
    const auto waits = [&] {
        const bool has_work = !is_paused_ || steps_left_ > 0 || question_;
        return (is_held_ || !has_work) && !is_stopped_ && !stop.load();
    };
    if (waits()) pace_.interrupt();
    while (waits()) woken_.wait_for(lock, k_signal_latency);
    // A question is answered before the next step is made.
    if (!question_ && is_paused_ && steps_left_ > 0) --steps_left_;
    return !is_stopped_;
}

std::optional<LiveControl::Question> LiveChannel::take_question() {
    const std::lock_guard lock(mutex_);
    return std::exchange(question_, std::nullopt);
}

void LiveChannel::anatomy(std::shared_ptr<const StepAnatomy> answer) {
    {
        const std::lock_guard lock(mutex_);
        anatomy_ = std::move(answer);
    }
    on_news_();
}

void LiveChannel::refused_question(const std::string& reason) {
    {
        const std::lock_guard lock(mutex_);
        messages_.push_back(reason);
    }
    on_news_();
}

bool LiveChannel::wants_look() {
    const std::lock_guard lock(mutex_);
    // In a pause, and on the way to an event, every step is looked at; else as often as it can be
    // shown.
    return is_paused_ || look_is_due_ || seeks_event_ ||
           (look_ == nullptr && std::chrono::steady_clock::now() - looked_at_ > k_look_every);
}

void LiveChannel::see(const SnapshotPtr& now) {
    if (seeks_event_ && seen_ != nullptr) {
        if (std::optional<std::string> event = event_between(*seen_, *now, watched_)) {
            is_paused_ = true;
            seeks_event_ = false;
            messages_.push_back(std::move(*event));
        }
    }
    seen_ = now;
    const auto wall = std::chrono::steady_clock::now().time_since_epoch();
    pace_.see(now->time_s, std::chrono::duration<double>(wall).count());
}

void LiveChannel::look(SnapshotPtr now) {
    {
        const std::lock_guard lock(mutex_);
        see(now);
        look_ = std::move(now);
        looked_at_ = std::chrono::steady_clock::now();
        look_is_due_ = false;
    }
    on_news_();
}

std::vector<Change> LiveChannel::take_changes() {
    const std::lock_guard lock(mutex_);
    return std::exchange(ordered_, {});
}

void LiveChannel::changed(const Change& change) {
    {
        const std::lock_guard lock(mutex_);
        changes_.push_back(change);
    }
    on_news_();
}

void LiveChannel::refused(const Change& change, const std::string& reason) {
    static_cast<void>(change);
    refused_question(reason);
}

}  // namespace spheroscope::viewer
