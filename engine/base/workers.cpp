#include "engine/base/workers.hpp"

#include <algorithm>

namespace spheroscope {

Workers::Workers(int n_threads)
    : n_threads_(std::max(1, n_threads)), inside_(n_threads_), gate_(n_threads_),
      items_done_(static_cast<std::size_t>(n_threads_)) {
    for (int index = 1; index < n_threads_; ++index)
        threads_.emplace_back([this, index] { thread_main(index); });
}

Workers::~Workers() {
    if (n_threads_ > 1) {
        stop_ = true;
        gate_.arrive_and_wait();
        for (std::thread& thread : threads_) thread.join();
    }
}

void Workers::thread_main(int index) {
    while (true) {
        gate_.arrive_and_wait();
        if (stop_) return;
        Member member(this, index);
        job_.call(job_.function, member);
        gate_.arrive_and_wait();
    }
}

void Workers::run_job(const Job& job) {
    Member self(this, 0);
    if (n_threads_ == 1) {
        job.call(job.function, self);
        return;
    }
    job_ = job;
    gate_.arrive_and_wait();
    job.call(job.function, self);
    gate_.arrive_and_wait();
}

std::vector<std::int64_t> Workers::items_done() const {
    std::vector<std::int64_t> counts;
    counts.reserve(items_done_.size());
    for (const Counter& counter : items_done_) counts.push_back(counter.count);
    return counts;
}

void Workers::Member::wait() {
    if (workers_->n_threads_ > 1) workers_->inside_.arrive_and_wait();
}

Workers::Member::Range Workers::Member::share(int n_items) const {
    const int n = workers_->n_threads_;
    const auto cut = [&](int k) { return static_cast<int>(std::int64_t{n_items} * k / n); };
    return {cut(index_), cut(index_ + 1)};
}

}  // namespace spheroscope
