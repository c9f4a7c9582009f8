#pragma once

#include "engine/base/team_choice.hpp"

#include <atomic>
#include <barrier>
#include <cstdint>
#include <thread>
#include <vector>

namespace spheroscope {

/// A small pool of threads that all run the same function (one parallel region), with a barrier
/// inside it. Why not OpenMP: its barriers spin on a busy machine, and ThreadSanitizer cannot see
/// them. The caller is member 0, so a pool of one starts no thread at all.
///
/// Nothing here may change a result: work is cut by item (cell, cell pair), every item is computed
/// by one member, and sums over items are taken in index order. Then the bits do not depend on the
/// number of threads, and `loop` may hand out items in any order. So the caller may also work alone
/// while others use the machine (TeamChoice).
class Workers {
  public:
    explicit Workers(int n_threads);
    ~Workers();
    Workers(const Workers&) = delete;
    Workers& operator=(const Workers&) = delete;

    /// As many members as a region has at most.
    [[nodiscard]] int size() const { return n_threads_; }

    /// What a member sees inside a region.
    class Member {
      public:
        [[nodiscard]] int index() const { return index_; }
        /// Waits for all members of the region. Every member must call it equally often.
        void wait();
        /// This member's share of n_items, contiguous; the shares of all members tile 0..n_items-1.
        struct Range {
            int begin, end;
        };
        [[nodiscard]] Range share(int n_items) const;

      private:
        friend class Workers;
        Member(Workers* workers, int index, int n_members)
            : workers_(workers), index_(index), n_members_(n_members) {}
        Workers* workers_;
        int index_, n_members_;
    };

    /// Runs f on every member of the region; returns when all are done. f must not throw. Nothing
    /// is copied: a region allocates no memory.
    template <class F> void region(const F& f) {
        run_job({[](const void* function, Member& member) {
                     (*static_cast<const F*>(function))(member);
                 },
                 &f});
    }

    /// Calls f(item) for the items 0..n_items-1. Each member begins with the item of its own index,
    /// so that none is late to an empty table; the others go to whichever member is free next.
    template <class F> void loop(int n_items, const F& f) {
        ticket_.store(n_members(), std::memory_order_relaxed);
        region([&](Member& member) {
            std::int64_t& done = items_done_[static_cast<std::size_t>(member.index_)].count;
            for (int item = member.index_; item < n_items; item = next_ticket(), ++done) f(item);
        });
    }

    /// Items that each member has computed since the pool was made (a test asserts that all
    /// worked).
    [[nodiscard]] std::vector<std::int64_t> items_done() const;

  private:
    struct alignas(64) Counter {
        std::int64_t count = 0;
    };
    /// A function of the caller, which outlives the region.
    struct Job {
        void (*call)(const void* function, Member& member) = nullptr;
        const void* function = nullptr;
    };
    /// That the next region has.
    [[nodiscard]] int n_members() const { return choice_.is_together() ? n_threads_ : 1; }
    void run_job(const Job& job);
    void watch(double wall_s, double own_cpu_s);
    [[nodiscard]] double cpu_of_others_s() const;
    [[nodiscard]] int next_ticket() { return ticket_.fetch_add(1, std::memory_order_relaxed); }
    void thread_main(int index);

    int n_threads_;
    std::atomic<int> ticket_{0};
    std::barrier<> inside_;  // between the phases of a region
    std::barrier<> gate_;    // start and end of a region
    Job job_;
    bool stop_ = false;
    std::vector<Counter> items_done_;
    std::vector<std::thread> threads_;
    TeamChoice choice_;
    double window_wall_s_ = 0.0, window_cpu_s_ = 0.0, others_before_s_ = 0.0;
};

}  // namespace spheroscope
