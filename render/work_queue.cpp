#include "render/work_queue.hpp"

#include <utility>

namespace spheroscope::render {

WorkQueue::WorkQueue(std::size_t capacity) : capacity_(capacity), thread_([this] { work(); }) {}

WorkQueue::~WorkQueue() { stop(); }

void WorkQueue::add(std::function<void()> job) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return failure_ || waiting_.size() < capacity_; });
    if (failure_) std::rethrow_exception(failure_);
    waiting_.push_back(std::move(job));
    lock.unlock();
    changed_.notify_all();
}

void WorkQueue::finish() {
    stop();
    if (failure_) std::rethrow_exception(failure_);
}

void WorkQueue::stop() {
    {
        const std::lock_guard lock(mutex_);
        no_more_ = true;
    }
    changed_.notify_all();
    if (thread_.joinable()) thread_.join();
}

void WorkQueue::work() {
    std::unique_lock lock(mutex_);
    while (true) {
        changed_.wait(lock, [this] { return no_more_ || !waiting_.empty(); });
        if (waiting_.empty()) return;
        const std::function<void()> job = std::move(waiting_.front());
        waiting_.pop_front();
        lock.unlock();
        changed_.notify_all();
        std::exception_ptr failure;
        try {
            job();
        } catch (...) {
            failure = std::current_exception();
        }
        lock.lock();
        if (failure) {
            failure_ = failure;
            waiting_.clear();
            changed_.notify_all();
            return;
        }
    }
}

}  // namespace spheroscope::render
