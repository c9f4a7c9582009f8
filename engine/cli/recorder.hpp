#pragma once

#include "engine/cli/store_thread.hpp"
#include "engine/run/engine.hpp"

#include <string>
#include <vector>

namespace spheroscope::cli {

/// What brings a run to the disk while it goes on: its frames by a thread of their own, and in step
/// with them its checkpoints and the list of what was changed.
class Recorder {
  public:
    /// Begins the file, or goes on with the one that is there. changes: those that the run begins
    /// with. `engine` must outlive this object. Throws Error.
    Recorder(const Engine& engine, const std::string& run_file, bool continues_file,
             std::vector<Change> changes);
    /// The store sees the end of its frames before it is joined.
    ~Recorder() { queue_.close(); }
    Recorder(const Recorder&) = delete;
    Recorder& operator=(const Recorder&) = delete;

    /// Records the changes that the run begins with, and makes `sinks` take frames, checkpoints and
    /// further changes, on the engine's thread. Throws Error.
    void add_to(EngineSinks& sinks);
    /// No more frames will come: waits for those that are there. The last one may fail after the
    /// last push; then the result says so.
    void end(RunResult& result);

    /// After end().
    [[nodiscard]] StoreThread& store() { return store_; }
    [[nodiscard]] const std::vector<Change>& changes() const { return changes_; }

  private:
    void add_change(const Change& change);

    const Engine& engine_;
    const std::string run_file_;
    std::vector<Change> changes_;
    FrameQueue queue_;
    StoreThread store_;
};

}  // namespace spheroscope::cli
