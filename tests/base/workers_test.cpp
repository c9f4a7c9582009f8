#include "engine/base/workers.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <numeric>
#include <set>
#include <thread>
#include <vector>

namespace spheroscope {
namespace {

class Pool : public testing::TestWithParam<int> {};

TEST_P(Pool, LoopComputesEveryItemExactlyOnce) {
    Workers workers(GetParam());
    for (const int n_items : {0, 1, 7, 1000}) {
        std::vector<std::atomic<int>> visits(static_cast<std::size_t>(n_items));
        workers.loop(n_items, [&](int item) { ++visits[static_cast<std::size_t>(item)]; });
        for (int item = 0; item < n_items; ++item)
            EXPECT_EQ(visits[static_cast<std::size_t>(item)], 1) << "item " << item;
    }
}

// Each of the first items is held until as many have begun as there are members: a member that does
// not work would let the others wait for ever, and the test would end by its time limit.
TEST_P(Pool, EveryMemberTakesPartInALoop) {
    Workers workers(GetParam());
    std::atomic<int> begun = 0;
    workers.loop(workers.size(), [&](int) {
        ++begun;
        while (begun < workers.size()) std::this_thread::yield();
    });
    EXPECT_EQ(workers.items_done(),
              std::vector<std::int64_t>(static_cast<std::size_t>(workers.size()), 1));
}

TEST_P(Pool, RegionRunsOnceOnEveryMemberEachOnItsOwnThread) {
    Workers workers(GetParam());
    const auto size = static_cast<std::size_t>(workers.size());
    std::vector<int> runs(size);
    std::vector<std::thread::id> threads(size);
    workers.region([&](Workers::Member& member) {
        const auto index = static_cast<std::size_t>(member.index());
        ++runs[index];
        threads[index] = std::this_thread::get_id();
    });
    EXPECT_EQ(runs, std::vector<int>(size, 1));
    EXPECT_EQ(std::set<std::thread::id>(threads.begin(), threads.end()).size(), size);
    EXPECT_EQ(threads[0], std::this_thread::get_id());  // the caller is member 0
}

// In every phase a member adds up what all members wrote in the phase before: one that ran ahead of
// a barrier, or fell behind it, would read a number of another phase.
TEST_P(Pool, WaitSeparatesThePhasesOfARegion) {
    Workers workers(GetParam());
    const auto size = static_cast<std::size_t>(workers.size());
    constexpr int n_phases = 200;
    std::vector<int> written(size);
    std::vector<int> wrong(size);
    workers.region([&](Workers::Member& member) {
        const auto index = static_cast<std::size_t>(member.index());
        for (int phase = 1; phase <= n_phases; ++phase) {
            written[index] = phase;
            member.wait();
            const int sum = std::accumulate(written.begin(), written.end(), 0);
            if (sum != phase * workers.size()) ++wrong[index];
            member.wait();
        }
    });
    EXPECT_EQ(wrong, std::vector<int>(size, 0));
}

TEST_P(Pool, SharesOfTheMembersTileTheItemsEvenly) {
    Workers workers(GetParam());
    for (const int n_items : {0, 1, 5, 64, 1001}) {
        std::vector<Workers::Member::Range> shares(static_cast<std::size_t>(workers.size()));
        workers.region([&](Workers::Member& member) {
            shares[static_cast<std::size_t>(member.index())] = member.share(n_items);
        });
        int next = 0;
        for (const auto& share : shares) {
            EXPECT_EQ(share.begin, next);
            EXPECT_LE(share.end - share.begin, n_items / workers.size() + 1);
            next = share.end;
        }
        EXPECT_EQ(next, n_items);
    }
}

TEST_P(Pool, ManyShortRegionsAllComplete) {
    Workers workers(GetParam());
    std::atomic<std::int64_t> sum = 0;
    constexpr int n_regions = 300;
    for (int region = 0; region < n_regions; ++region)
        workers.loop(3, [&](int item) { sum += item; });
    EXPECT_EQ(sum, 3 * n_regions);
    const std::vector<std::int64_t> done = workers.items_done();
    EXPECT_EQ(std::accumulate(done.begin(), done.end(), std::int64_t{0}), 3 * n_regions);
}

TEST_P(Pool, CanBeDestroyedWithoutEverHavingWorked) {
    for (int repeat = 0; repeat < 20; ++repeat) {
        const Workers workers(GetParam());
        EXPECT_EQ(workers.size(), GetParam());
    }
}

INSTANTIATE_TEST_SUITE_P(Sizes, Pool, testing::Values(1, 2, 3, 16));

}  // namespace
}  // namespace spheroscope
