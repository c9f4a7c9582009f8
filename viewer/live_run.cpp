#include "viewer/live_run.hpp"

#include "engine/base/error.hpp"
#include "engine/base/priority.hpp"

#include <fmt/format.h>

#include <chrono>
#include <utility>

namespace spheroscope::viewer {

LiveRun::LiveRun(const scene::Scene& scene, const cli::RunPlace& place,
                 const cli::CommonOptions& options, Begin begin, const cli::Invocation& invocation,
                 std::function<void()> on_news)
    : scene_(scene), scene_now_(scene), channel_(on_news) {
    if (begin.paused) channel_.pause();
    thread_ = std::thread([this, place, options, begin, invocation, on_news] {
        let_other_threads_first();  // a view that is being turned must not wait for the engine
        try {
            summary_ =
                cli::simulate(scene_, place, options, begin.overwrite, invocation, {}, &channel_);
        } catch (...) {
            trouble_ = std::current_exception();
        }
        is_over_.store(true);
        channel_.end();
        on_news();
    });
    header_ = channel_.wait_for_header();
    if (!header_) {
        thread_.join();
        std::rethrow_exception(trouble_);  // a run that is not resumed begins, or says why not
    }
    survey_.emplace(*header_);
}

LiveRun::~LiveRun() {
    channel_.stop();
    if (thread_.joinable()) thread_.join();
}

std::vector<double> LiveRun::take_new_times() {
    std::vector<double> new_times_s;
    for (SnapshotPtr& frame : channel_.take_frames()) {
        survey_->add(*frame);
        new_times_s.push_back(frame->time_s);
        kept_bytes_ += bytes_of(*frame);
        frames_.push_back(std::move(frame));
    }
    for (; kept_bytes_ > k_kept_bytes && first_kept_ + 1 < frames_.size(); ++first_kept_) {
        kept_bytes_ -= bytes_of(*frames_[first_kept_]);
        frames_[first_kept_].reset();
    }
    return new_times_s;
}

SnapshotPtr LiveRun::frame(int number) {
    const auto index = static_cast<std::size_t>(number);
    if (index >= frames_.size()) return nullptr;
    failure_ = frames_[index] != nullptr
                   ? ""
                   : fmt::format("frame {} is in the run's file only: the panel keeps the newest "
                                 "frames, from {} on",
                                 number, first_kept_);
    return frames_[index];
}

void LiveRun::watch_contact(std::optional<inspect::ContactKey> key) {
    historian_ = key ? std::make_unique<inspect::ContactHistorian>(header_, *key) : nullptr;
    contact_history_ =
        key ? std::make_shared<const std::vector<inspect::ContactSummary>>() : nullptr;
    contact_rows_.clear();
    contact_failure_.clear();
    n_told_ = 0;
}

ContactRows LiveRun::contact_history() {
    if (historian_ == nullptr) return contact_history_;
    constexpr int most_at_once = 4;
    for (int k = 0; k < most_at_once && n_told_ < frames_.size() && contact_failure_.empty();
         ++n_told_) {
        if (frames_[n_told_] == nullptr) continue;
        try {
            contact_rows_.push_back(historian_->summary_of(frames_[n_told_]));
        } catch (const Error& error) {
            contact_failure_ = fmt::format("the contact's history ends before frame {}: {}",
                                           n_told_, error.what());
        }
        ++k;
    }
    // All rows so far are copied: for each new one that would take longer the longer the run is.
    const auto now = std::chrono::steady_clock::now();
    if (contact_history_->size() != contact_rows_.size() && now - told_at_ > k_telling_every) {
        told_at_ = now;
        contact_history_ =
            std::make_shared<const std::vector<inspect::ContactSummary>>(contact_rows_);
    }
    return contact_history_;
}

void LiveRun::take_look() {
    if (SnapshotPtr look = channel_.take_look()) looks_.add(std::move(look));
}

SnapshotPtr LiveRun::newest_look() const {
    SnapshotPtr look = looks_.back(0);
    if (look == nullptr || frames_.empty()) return look;
    return look->time_s > frames_.back()->time_s ? look : nullptr;
}

const scene::Scene& LiveRun::scene_now() {
    const std::vector<Change> changes = channel_.changes();
    for (; n_changes_ < changes.size(); ++n_changes_) apply_change(scene_now_, changes[n_changes_]);
    return scene_now_;
}

std::string LiveRun::end_text() const {
    std::string text = "the run is over";
    try {
        if (trouble_) std::rethrow_exception(trouble_);
        text += ": " + summary_->result.outcome;
        if (!summary_->result.message.empty()) text += ": " + summary_->result.message;
    } catch (const std::exception& error) {
        text += fmt::format(": {}", error.what());
    }
    return text;
}

cli::SimulationSummary LiveRun::finish() {
    channel_.stop();
    if (thread_.joinable()) thread_.join();
    if (trouble_) std::rethrow_exception(trouble_);
    return *summary_;
}

}  // namespace spheroscope::viewer
