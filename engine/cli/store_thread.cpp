#include "engine/cli/store_thread.hpp"

#include <utility>

namespace spheroscope::cli {

StoreThread::StoreThread(RunFileWriter writer, FrameQueue::Reader reader)
    : writer_(std::move(writer)), n_written_(writer_.n_frames()),
      thread_([this, r = std::move(reader)]() mutable { write_all(r); }) {}

void StoreThread::join() {
    if (thread_.joinable()) thread_.join();
}

void StoreThread::when_written(int n_frames, const std::function<void()>& action) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return n_written_ >= n_frames || has_failed(); });
    if (!has_failed()) action();
}

void StoreThread::record_changes(const std::vector<Change>& changes) {
    const std::lock_guard lock(mutex_);
    if (!has_failed()) writer_.record_changes(changes);
}

void StoreThread::write_all(FrameQueue::Reader& reader) {
    while (SnapshotPtr frame = reader.next()) {
        const std::lock_guard lock(mutex_);
        try {
            writer_.write(*frame);
        } catch (const Error& error) {
            return fail(reader, error.what(), error.code());
        } catch (const std::exception& error) {
            return fail(reader, std::string("internal error: ") + error.what(), ExitCode::internal);
        }
        ++n_written_;
        last_ = std::move(frame);
        changed_.notify_all();
    }
}

void StoreThread::fail(FrameQueue::Reader& reader, const std::string& reason, ExitCode code) {
    failure_ = code;
    reader.fail(reason);
    changed_.notify_all();
}

}  // namespace spheroscope::cli
