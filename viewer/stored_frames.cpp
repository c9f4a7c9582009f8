#include "viewer/stored_frames.hpp"

#include "viewer/model/kept_looks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <utility>

namespace spheroscope::viewer {
namespace {

/// Frames that are read ahead of the one that is shown, for playing.
constexpr int k_ahead = 4;

}  // namespace

StoredFrames::StoredFrames(const std::string& path, std::function<void()> on_news)
    : reader_(path), on_news_(std::move(on_news)), survey_(*reader_.header()), gathered_(survey_),
      thread_([this] { read_all(); }) {}

StoredFrames::~StoredFrames() {
    {
        const std::lock_guard lock(mutex_);
        is_over_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

std::vector<double> StoredFrames::take_new_times() {
    std::vector<double> time_s;
    if (!std::exchange(times_taken_, true))
        for (int i = 0; i < reader_.n_frames(); ++i) time_s.push_back(reader_.time(i));
    return time_s;
}

SnapshotPtr StoredFrames::frame(int number) {
    const std::lock_guard lock(mutex_);
    if (number != wanted_) {
        wanted_ = number;
        changed_.notify_all();
    }
    return find(number);
}

void StoredFrames::begin_survey() {
    {
        const std::lock_guard lock(mutex_);
        may_survey_ = true;
    }
    changed_.notify_all();
}

RunSurvey StoredFrames::survey() {
    const std::lock_guard lock(mutex_);
    return survey_;
}

int StoredFrames::n_surveyed() {
    const std::lock_guard lock(mutex_);
    return survey_.n_frames();
}

std::string StoredFrames::failure() {
    const std::lock_guard lock(mutex_);
    const auto found = unreadable_.find(wanted_);
    return found == unreadable_.end() ? "" : found->second;
}

std::string StoredFrames::contact_failure() {
    const std::lock_guard lock(mutex_);
    return contact_failure_;
}

void StoredFrames::watch_contact(std::optional<inspect::ContactKey> key) {
    std::shared_ptr<Watch> watch;
    if (key) watch = std::make_shared<Watch>(reader_.header(), *key);
    {
        const std::lock_guard lock(mutex_);
        watch_ = std::move(watch);
        contact_failure_.clear();
        contact_history_ =
            key ? std::make_shared<const std::vector<inspect::ContactSummary>>() : nullptr;
    }
    changed_.notify_all();
}

ContactRows StoredFrames::contact_history() {
    const std::lock_guard lock(mutex_);
    return contact_history_;
}

bool StoredFrames::history_wants(int number) const {
    return watch_ != nullptr && contact_failure_.empty() && number < reader_.n_frames() &&
           number == static_cast<int>(watch_->rows.size());
}

SnapshotPtr StoredFrames::find(int number) const {
    const auto found = std::find_if(kept_.begin(), kept_.end(),
                                    [&](const SnapshotPtr& s) { return s->frame == number; });
    return found == kept_.end() ? nullptr : *found;
}

void StoredFrames::keep(SnapshotPtr snapshot) {
    kept_bytes_ += bytes_of(*snapshot);
    kept_.push_front(std::move(snapshot));
    while (kept_bytes_ > k_kept_bytes && kept_.size() > k_ahead + 1) {
        // not the one that is on show, which nothing has touched while others were read
        auto last = std::prev(kept_.end());
        if ((*last)->frame == wanted_) --last;
        kept_bytes_ -= bytes_of(**last);
        kept_.erase(last);
    }
}

int StoredFrames::next_wanted() const {
    const int n_frames = reader_.n_frames();
    if (wanted_ >= 0) {
        const int last = std::min(wanted_ + k_ahead, n_frames - 1);
        for (int i = wanted_; i <= last; ++i)
            if (!find(i) && !unreadable_.contains(i)) return i;
    }
    if (watch_ != nullptr)
        if (const auto next = static_cast<int>(watch_->rows.size()); history_wants(next))
            return next;
    return may_survey_ && gathered_.n_frames() < n_frames ? gathered_.n_frames() : -1;
}

void StoredFrames::tell(bool is_waited_for) {
    const auto now = std::chrono::steady_clock::now();
    if (!is_waited_for && now - told_at_ < k_telling_every) return;
    told_at_ = now;
    if (survey_.n_frames() != gathered_.n_frames()) survey_ = RunSurvey(gathered_);
    if (watch_ != nullptr && contact_history_->size() != watch_->rows.size())
        contact_history_ =
            std::make_shared<const std::vector<inspect::ContactSummary>>(watch_->rows);
    on_news_();
}

void StoredFrames::read_all() {
    std::unique_lock lock(mutex_);
    while (true) {
        changed_.wait(lock, [&] { return is_over_ || next_wanted() >= 0; });
        if (is_over_) return;
        const int number = next_wanted();
        SnapshotPtr snapshot = find(number);
        if (!snapshot && !unreadable_.contains(number)) snapshot = read(number, lock);
        if (history_wants(number)) add_to_history(snapshot, number, lock);
        if (number == gathered_.n_frames()) add_to_survey(snapshot, lock);
        tell(number == wanted_ || next_wanted() < 0);
    }
}

SnapshotPtr StoredFrames::read(int number, std::unique_lock<std::mutex>& lock) {
    SnapshotPtr snapshot;
    std::string failure;
    lock.unlock();
    try {
        snapshot = reader_.frame(number);
    } catch (const std::exception& error) {
        failure = error.what();
    }
    lock.lock();
    if (snapshot)
        keep(snapshot);
    else
        unreadable_[number] = failure;
    return snapshot;
}

void StoredFrames::add_to_survey(const SnapshotPtr& snapshot, std::unique_lock<std::mutex>& lock) {
    lock.unlock();
    if (snapshot)
        gathered_.add(*snapshot);
    else
        gathered_.add_unreadable(reader_.time(gathered_.n_frames()));
    lock.lock();
}

void StoredFrames::add_to_history(const SnapshotPtr& snapshot, int number,
                                  std::unique_lock<std::mutex>& lock) {
    const std::shared_ptr<Watch> watch = watch_;
    std::string failure = snapshot ? "" : unreadable_.at(number);
    lock.unlock();
    if (snapshot) {
        try {
            watch->rows.push_back(watch->historian.summary_of(snapshot));
        } catch (const std::exception& error) {
            failure = error.what();
        }
    }
    lock.lock();
    // Another contact may be watched by now.
    if (watch == watch_ && !failure.empty())
        contact_failure_ =
            fmt::format("the contact's history ends before frame {}: {}", number, failure);
}

}  // namespace spheroscope::viewer
