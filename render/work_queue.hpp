#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace spheroscope::render {

/// One thread that does jobs in their order; at most `capacity` wait. The first exception of a job
/// is thrown to the one who adds or finishes; later jobs are then dropped.
class WorkQueue {
  public:
    explicit WorkQueue(std::size_t capacity);
    /// Does the jobs that wait, keeps their exceptions to itself: call finish() first to see them.
    ~WorkQueue();
    WorkQueue(const WorkQueue&) = delete;
    WorkQueue& operator=(const WorkQueue&) = delete;

    void add(std::function<void()> job);
    /// Returns when all jobs are done.
    void finish();

  private:
    void work();
    void stop();

    std::size_t capacity_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<std::function<void()>> waiting_;  // guarded by mutex_
    bool no_more_ = false;                       // guarded by mutex_
    std::exception_ptr failure_;                 // guarded by mutex_
    std::thread thread_;                         // last: starts when all else is there
};

}  // namespace spheroscope::render
