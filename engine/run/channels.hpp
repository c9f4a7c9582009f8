#pragma once

#include "engine/run/snapshot.hpp"

#include <memory>
#include <optional>
#include <string>

// How frames leave the engine's thread for a file. A frame is an immutable Snapshot, so only a
// pointer changes hands, under a mutex that is held for one pointer move.
//
//   engine --push--> FrameQueue --next--> store    every frame, in order; the engine waits for the
//                                                  slowest reader, nothing is dropped
//
// Movies are drawn from what is stored, since one range of colours needs the whole run. Whoever
// watches a run gets its frames, and states between them, by LiveControl (live_control.hpp).
//
// Why a bounded queue: a disk may take longer for a frame than the engine for the steps before it,
// and an unbounded queue would then keep the whole run in memory. Why a reader's failure stops the
// producer: a run whose file has a hole is worth less than one that ends with a reason.
namespace spheroscope {

/// One producer, any number of readers; each reader sees every frame in the order of push().
class FrameQueue {
    struct Shared;

  public:
    /// One reader's end, used by one thread. May outlive the queue.
    class Reader {
      public:
        Reader(Reader&&) noexcept = default;
        Reader& operator=(Reader&&) = delete;
        /// Leaving before the end is a failure: otherwise the producer would wait for ever.
        ~Reader();

        /// The next frame; waits for it. nullptr when the queue is closed and every frame was seen.
        [[nodiscard]] SnapshotPtr next();
        /// Tells the producer why this reader cannot go on. The first reason of all readers is
        /// kept. The reader gets no more frames after it.
        void fail(const std::string& reason);

      private:
        friend class FrameQueue;
        Reader(std::shared_ptr<Shared> shared, std::size_t index)
            : shared_(std::move(shared)), index_(index) {}
        std::shared_ptr<Shared> shared_;
        std::size_t index_;
    };

    /// `capacity`: frames that the slowest reader may be behind before push() waits; at least 1.
    explicit FrameQueue(int capacity);
    /// Closes the queue.
    ~FrameQueue();
    FrameQueue(const FrameQueue&) = delete;
    FrameQueue& operator=(const FrameQueue&) = delete;

    /// `name` is for messages ("store"). Precondition: nothing was pushed yet, so that
    /// every reader sees every frame.
    [[nodiscard]] Reader add_reader(const std::string& name);

    /// Hands a frame to all readers; waits while one of them is `capacity` frames behind. Returns
    /// nothing if all is well, or the reason of the reader that failed: then the frame was not
    /// taken, and the run must stop. Precondition: the queue is open.
    [[nodiscard]] std::optional<std::string> push(SnapshotPtr frame);

    /// No more frames will come; readers see what was pushed, then the end. May be called twice.
    void close();

    /// Why a reader failed, if one did. To be asked once more after the readers have ended: the
    /// last frame may fail after the last push().
    [[nodiscard]] std::optional<std::string> failure() const;

  private:
    std::shared_ptr<Shared> shared_;
};

}  // namespace spheroscope
