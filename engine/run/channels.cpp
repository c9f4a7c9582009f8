#include "engine/run/channels.hpp"

#include "engine/base/error.hpp"

#include <algorithm>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <utility>
#include <vector>

namespace spheroscope {

//          frame n_dropped_      frame n_pushed - 1
//               |                     |
//   frames:     [ . . . . . . . . . . ]        a frame leaves when all active readers have seen it
//                     ^         ^
//                slow n_seen   fast n_seen
struct FrameQueue::Shared {
    struct ReaderState {
        std::string name;
        std::int64_t n_seen = 0;
        bool active = true;
    };

    explicit Shared(int room) : capacity(room) {}

    const int capacity;
    mutable std::mutex mutex;
    std::condition_variable changed;
    std::deque<SnapshotPtr> frames;
    std::int64_t n_dropped = 0;  // frames that all readers have seen and that are no longer here
    std::vector<ReaderState> readers;
    std::optional<std::string> reason;
    bool closed = false;

    [[nodiscard]] std::int64_t n_pushed() const {
        return n_dropped + static_cast<std::int64_t>(frames.size());
    }

    /// Takes out the frames that no active reader needs. They are returned, so that the last owner
    /// frees their arrays after the mutex is released.
    [[nodiscard]] std::vector<SnapshotPtr> take_out_seen() {
        std::int64_t seen_by_all = n_pushed();
        for (const ReaderState& reader : readers)
            if (reader.active) seen_by_all = std::min(seen_by_all, reader.n_seen);
        std::vector<SnapshotPtr> seen;
        for (; n_dropped < seen_by_all; ++n_dropped) {
            seen.push_back(std::move(frames.front()));
            frames.pop_front();
        }
        return seen;
    }

    void leave(std::size_t index, const std::string& why) {
        std::vector<SnapshotPtr> seen;  // freed last, without the mutex
        const std::lock_guard lock(mutex);
        ReaderState& reader = readers[index];
        if (!reader.active) return;
        reader.active = false;
        if (!why.empty() && !reason) reason = reader.name + ": " + why;
        seen = take_out_seen();
        changed.notify_all();
    }

    [[nodiscard]] bool has_seen_all(std::size_t index) const {
        const std::lock_guard lock(mutex);
        return closed && readers[index].n_seen == n_pushed();
    }
};

FrameQueue::Reader::~Reader() {
    if (!shared_) return;  // moved from
    const bool at_end = shared_->has_seen_all(index_);
    shared_->leave(index_, at_end ? "" : "stopped reading before the last frame");
}

SnapshotPtr FrameQueue::Reader::next() {
    std::vector<SnapshotPtr> seen;  // freed last, without the mutex
    std::unique_lock lock(shared_->mutex);
    const auto has_frame = [&] { return shared_->readers[index_].n_seen < shared_->n_pushed(); };
    // No reference to the element is kept across the wait: add_reader() may move the array.
    shared_->changed.wait(
        lock, [&] { return has_frame() || shared_->closed || !shared_->readers[index_].active; });
    Shared::ReaderState& reader = shared_->readers[index_];
    if (!reader.active || !has_frame()) return nullptr;
    SnapshotPtr frame =
        shared_->frames[static_cast<std::size_t>(reader.n_seen - shared_->n_dropped)];
    ++reader.n_seen;
    seen = shared_->take_out_seen();
    if (!seen.empty()) shared_->changed.notify_all();
    return frame;
}

void FrameQueue::Reader::fail(const std::string& reason) {
    shared_->leave(index_, reason.empty() ? "failed without a reason" : reason);
}

FrameQueue::FrameQueue(int capacity) : shared_(std::make_shared<Shared>(capacity)) {
    SPHEROSCOPE_ASSERT(capacity >= 1, "capacity " + std::to_string(capacity));
}

FrameQueue::~FrameQueue() { close(); }

FrameQueue::Reader FrameQueue::add_reader(const std::string& name) {
    const std::lock_guard lock(shared_->mutex);
    SPHEROSCOPE_ASSERT(shared_->n_pushed() == 0, "reader " + name + " comes after the first frame");
    shared_->readers.push_back({name});
    return {shared_, shared_->readers.size() - 1};
}

std::optional<std::string> FrameQueue::push(SnapshotPtr frame) {
    SPHEROSCOPE_ASSERT(frame != nullptr, "a frame");
    std::vector<SnapshotPtr> seen;  // freed last, without the mutex
    std::unique_lock lock(shared_->mutex);
    SPHEROSCOPE_ASSERT(!shared_->closed, "push after close");
    shared_->changed.wait(
        lock, [&] { return shared_->reason || std::ssize(shared_->frames) < shared_->capacity; });
    if (shared_->reason) return shared_->reason;
    shared_->frames.push_back(std::move(frame));
    seen = shared_->take_out_seen();  // without readers nobody needs it
    shared_->changed.notify_all();
    return std::nullopt;
}

void FrameQueue::close() {
    const std::lock_guard lock(shared_->mutex);
    shared_->closed = true;
    shared_->changed.notify_all();
}

std::optional<std::string> FrameQueue::failure() const {
    const std::lock_guard lock(shared_->mutex);
    return shared_->reason;
}

}  // namespace spheroscope
