#include "viewer/stored_frames.hpp"

#include "engine/base/error.hpp"

#include <algorithm>
#include <exception>
#include <utility>

namespace spheroscope::viewer {
namespace {

/// Frames that are read ahead of the one that is shown, for playing.
constexpr int k_ahead = 4;

/// The panel is drawn for each news: more of them would take the time from reading.
constexpr std::chrono::milliseconds k_telling_every{100};

std::size_t bytes_of(const Snapshot& snapshot) {
    std::size_t n = snapshot.x_um.size() + snapshot.normal.size();
    for (const std::vector<float>& values : snapshot.fields) n += values.size();
    return n * sizeof(float);
}

}  // namespace

StoredFrames::StoredFrames(const std::string& path, std::function<void()> on_news)
    : reader_(path), on_news_(std::move(on_news)), survey_(*reader_.header()),
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
    return failure_;
}

void StoredFrames::watch_contact(std::optional<inspect::ContactKey> key) {
    std::shared_ptr<inspect::ContactHistorian> historian;
    if (key) historian = std::make_shared<inspect::ContactHistorian>(reader_.header(), *key);
    {
        const std::lock_guard lock(mutex_);
        historian_ = std::move(historian);
        contact_history_ =
            key ? std::make_shared<const std::vector<inspect::ContactSummary>>() : nullptr;
    }
    changed_.notify_all();
}

ContactRows StoredFrames::contact_history() {
    const std::lock_guard lock(mutex_);
    return contact_history_;
}

int StoredFrames::n_contact_rows() const {
    return contact_history_ == nullptr ? reader_.n_frames()
                                       : static_cast<int>(contact_history_->size());
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
    if (!failure_.empty()) return -1;
    const int n_frames = reader_.n_frames();
    if (wanted_ >= 0) {
        const int last = std::min(wanted_ + k_ahead, n_frames - 1);
        for (int i = wanted_; i <= last; ++i)
            if (!find(i)) return i;
    }
    if (n_contact_rows() < n_frames) return n_contact_rows();
    return may_survey_ && survey_.n_frames() < n_frames ? survey_.n_frames() : -1;
}

void StoredFrames::tell(bool is_waited_for) {
    const auto now = std::chrono::steady_clock::now();
    if (!is_waited_for && now - told_at_ < k_telling_every) return;
    told_at_ = now;
    on_news_();
}

void StoredFrames::read_all() {
    std::unique_lock lock(mutex_);
    while (true) {
        changed_.wait(lock, [&] { return is_over_ || next_wanted() >= 0; });
        if (is_over_) return;
        const int number = next_wanted();
        SnapshotPtr snapshot = find(number);
        if (!snapshot) {
            lock.unlock();
            std::string failure;
            try {
                snapshot = reader_.frame(number);
            } catch (const std::exception& error) {
                failure = error.what();
            }
            lock.lock();
            if (!snapshot) {
                failure_ = failure;
                on_news_();
                continue;
            }
            keep(snapshot);
        }
        try {
            if (number == n_contact_rows()) add_to_history(snapshot, lock);
        } catch (const std::exception& error) {
            failure_ = error.what();
        }
        if (number == survey_.n_frames()) add_to_survey(*snapshot, lock);
        tell(number == wanted_ || next_wanted() < 0);
    }
}

void StoredFrames::add_to_survey(const Snapshot& snapshot, std::unique_lock<std::mutex>& lock) {
    RunSurvey survey = survey_;
    lock.unlock();
    survey.add(snapshot);
    lock.lock();
    survey_ = std::move(survey);
}

void StoredFrames::add_to_history(const SnapshotPtr& snapshot, std::unique_lock<std::mutex>& lock) {
    const std::shared_ptr<inspect::ContactHistorian> historian = historian_;
    std::vector<inspect::ContactSummary> rows = *contact_history_;
    lock.unlock();
    std::exception_ptr trouble;
    try {
        rows.push_back(historian->summary_of(snapshot));
    } catch (...) {
        trouble = std::current_exception();
    }
    lock.lock();
    if (trouble) std::rethrow_exception(trouble);
    // Another contact may be watched by now.
    if (historian == historian_)
        contact_history_ =
            std::make_shared<const std::vector<inspect::ContactSummary>>(std::move(rows));
}

}  // namespace spheroscope::viewer
