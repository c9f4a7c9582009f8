#include "engine/base/workers.hpp"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <pthread.h>

namespace spheroscope {
namespace {

double cpu_s(clockid_t clock) {
    timespec now{};
    clock_gettime(clock, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

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
        Member member(this, index, n_threads_);
        job_.call(job_.function, member);
        gate_.arrive_and_wait();
    }
}

void Workers::run_job(const Job& job) {
    Member self(this, 0, n_members());
    if (n_threads_ == 1) {
        job.call(job.function, self);
        return;
    }
    const auto begin = std::chrono::steady_clock::now();
    const double cpu_begin_s = cpu_s(CLOCK_THREAD_CPUTIME_ID);
    if (self.n_members_ == 1) {
        job.call(job.function, self);
    } else {
        job_ = job;
        gate_.arrive_and_wait();
        job.call(job.function, self);
        gate_.arrive_and_wait();
    }
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
    watch(wall.count(), cpu_s(CLOCK_THREAD_CPUTIME_ID) - cpu_begin_s);
}

// Only regions count: what the caller does between them, or waits for, says nothing about the team.
void Workers::watch(double wall_s, double own_cpu_s) {
    window_wall_s_ += wall_s;
    window_cpu_s_ += own_cpu_s;
    if (window_wall_s_ < TeamChoice::k_window_s) return;
    const double others_s = cpu_of_others_s();
    choice_.window(window_wall_s_, window_cpu_s_ + others_s - others_before_s_);
    others_before_s_ = others_s;
    window_wall_s_ = window_cpu_s_ = 0.0;
}

double Workers::cpu_of_others_s() const {
    double sum_s = 0.0;
    for (const std::thread& thread : threads_) {
        clockid_t clock{};
        // native_handle() is not const; it changes nothing
        if (pthread_getcpuclockid(const_cast<std::thread&>(thread).native_handle(), &clock) == 0)
            sum_s += cpu_s(clock);
    }
    return sum_s;
}

std::vector<std::int64_t> Workers::items_done() const {
    std::vector<std::int64_t> counts;
    counts.reserve(items_done_.size());
    for (const Counter& counter : items_done_) counts.push_back(counter.count);
    return counts;
}

void Workers::Member::wait() {
    if (n_members_ > 1) workers_->inside_.arrive_and_wait();
}

Workers::Member::Range Workers::Member::share(int n_items) const {
    const int n = n_members_;
    const auto cut = [&](int k) { return static_cast<int>(std::int64_t{n_items} * k / n); };
    return {cut(index_), cut(index_ + 1)};
}

}  // namespace spheroscope
