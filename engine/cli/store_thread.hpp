#pragma once

#include "engine/base/error.hpp"
#include "engine/run/channels.hpp"
#include "engine/store/run_file.hpp"

#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace spheroscope::cli {

/// Writes every frame of a queue in a thread of its own. HDF5 is not thread-safe, so whoever else
/// wants to use it meanwhile (the checkpoint) does so through when_written(). The queue must be
/// closed, or this reader has failed, before it is joined.
class StoreThread {
  public:
    StoreThread(RunFileWriter writer, FrameQueue::Reader reader);
    ~StoreThread() { join(); }
    StoreThread(const StoreThread&) = delete;
    StoreThread& operator=(const StoreThread&) = delete;

    void join();

    /// Waits for `n_frames` frames on the disk, then calls `action` with HDF5 to itself. Does not
    /// call it if the store has failed: what it would refer to is not there.
    void when_written(int n_frames, const std::function<void()>& action);

    /// Brings the list of changes to the disk. Throws Error.
    void record_changes(const std::vector<Change>& changes);

    // After join().
    void finish(const RunEnd& end) { writer_.finish(end); }
    [[nodiscard]] bool has_failed() const { return failure_ != ExitCode::ok; }
    /// What the failure means for the program's exit code; ok if there was none.
    [[nodiscard]] ExitCode failure() const { return failure_; }
    /// The last frame that this thread has written; nullptr if none.
    [[nodiscard]] SnapshotPtr last() const { return last_; }

  private:
    void write_all(FrameQueue::Reader& reader);
    void fail(FrameQueue::Reader& reader, const std::string& reason, ExitCode code);

    RunFileWriter writer_;
    int n_written_;
    ExitCode failure_ = ExitCode::ok;
    SnapshotPtr last_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::thread thread_;  // last: it starts when all else is there
};

}  // namespace spheroscope::cli
