#include "engine/run/channels.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <numeric>
#include <thread>

namespace spheroscope {
namespace {

SnapshotPtr numbered_frame(int number) {
    auto frame = std::make_shared<Snapshot>();
    frame->frame = number;
    return frame;
}

std::vector<int> read_all(FrameQueue::Reader& reader) {
    std::vector<int> numbers;
    while (const SnapshotPtr frame = reader.next()) numbers.push_back(frame->frame);
    return numbers;
}

std::vector<int> count_to(int n) {
    std::vector<int> numbers(static_cast<std::size_t>(n));
    std::iota(numbers.begin(), numbers.end(), 0);
    return numbers;
}

TEST(FrameQueue, EveryReaderSeesEveryFrameInOrder) {
    constexpr int k_frames = 2000, k_readers = 3;
    FrameQueue queue(4);
    std::vector<std::vector<int>> seen(k_readers);
    std::vector<std::thread> threads;
    for (int r = 0; r < k_readers; ++r) {
        FrameQueue::Reader reader = queue.add_reader("reader " + std::to_string(r));
        threads.emplace_back([r, &seen, own = std::move(reader)]() mutable {
            seen[static_cast<std::size_t>(r)] = read_all(own);
        });
    }
    for (int n = 0; n < k_frames; ++n) EXPECT_FALSE(queue.push(numbered_frame(n)));
    queue.close();
    for (std::thread& thread : threads) thread.join();
    for (const std::vector<int>& numbers : seen) EXPECT_EQ(numbers, count_to(k_frames));
    EXPECT_FALSE(queue.failure());
}

TEST(FrameQueue, ProducerWaitsForTheSlowestReader) {
    constexpr int k_capacity = 3;
    FrameQueue queue(k_capacity);
    FrameQueue::Reader fast = queue.add_reader("fast");
    FrameQueue::Reader slow = queue.add_reader("slow");
    std::atomic<int> n_pushed = 0;
    std::thread producer([&] {
        for (int n = 0; n < 10; ++n) {
            EXPECT_FALSE(queue.push(numbered_frame(n)));
            ++n_pushed;
        }
        queue.close();
    });
    for (int n = 0; n < k_capacity; ++n) EXPECT_EQ(fast.next()->frame, n);
    // Nothing can be awaited to show that something does not happen; time only makes this stricter.
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    EXPECT_EQ(n_pushed, k_capacity);
    EXPECT_EQ(slow.next()->frame, 0);
    EXPECT_EQ(fast.next()->frame, k_capacity);  // the place that `slow` made was filled
    std::thread rest([&] { EXPECT_EQ(read_all(fast).size(), 6U); });
    EXPECT_EQ(read_all(slow).size(), 9U);
    rest.join();
    producer.join();
}

TEST(FrameQueue, AFrameIsFreedWhenTheLastReaderHasSeenIt) {
    FrameQueue queue(4);
    FrameQueue::Reader a = queue.add_reader("a");
    FrameQueue::Reader b = queue.add_reader("b");
    SnapshotPtr frame = numbered_frame(0);
    const std::weak_ptr<const Snapshot> watch = frame;
    EXPECT_FALSE(queue.push(std::move(frame)));
    EXPECT_NE(a.next(), nullptr);
    EXPECT_FALSE(watch.expired());
    EXPECT_NE(b.next(), nullptr);
    EXPECT_TRUE(watch.expired());
    queue.close();
    EXPECT_EQ(a.next(), nullptr);
    EXPECT_EQ(b.next(), nullptr);
}

TEST(FrameQueue, AFailedReadersReasonReachesTheProducerAtItsNextPush) {
    FrameQueue queue(2);
    FrameQueue::Reader reader = queue.add_reader("store");
    EXPECT_FALSE(queue.push(numbered_frame(0)));
    reader.fail("disk full");
    const std::optional<std::string> reason = queue.push(numbered_frame(1));
    ASSERT_TRUE(reason);
    EXPECT_EQ(*reason, "store: disk full");
}

TEST(FrameQueue, AFailureWakesAProducerThatWaits) {
    FrameQueue queue(1);
    FrameQueue::Reader reader = queue.add_reader("movie");
    EXPECT_FALSE(queue.push(numbered_frame(0)));
    std::optional<std::string> reason;
    std::thread producer([&] { reason = queue.push(numbered_frame(1)); });
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    reader.fail("no ffmpeg");
    producer.join();
    EXPECT_EQ(reason, "movie: no ffmpeg");
}

TEST(FrameQueue, TheFirstReasonIsKept) {
    FrameQueue queue(2);
    FrameQueue::Reader a = queue.add_reader("a");
    FrameQueue::Reader b = queue.add_reader("b");
    a.fail("first");
    b.fail("second");
    EXPECT_EQ(queue.failure(), "a: first");
}

TEST(FrameQueue, OtherReadersStillSeeTheFramesBeforeAFailure) {
    FrameQueue queue(4);
    FrameQueue::Reader broken = queue.add_reader("broken");
    FrameQueue::Reader sound = queue.add_reader("sound");
    EXPECT_FALSE(queue.push(numbered_frame(0)));
    EXPECT_FALSE(queue.push(numbered_frame(1)));
    broken.fail("why not");
    EXPECT_EQ(broken.next(), nullptr);
    queue.close();
    EXPECT_EQ(read_all(sound), count_to(2));
}

TEST(FrameQueue, AReaderThatLeavesEarlyIsAFailureAndNotADeadlock) {
    FrameQueue queue(1);
    { const FrameQueue::Reader reader = queue.add_reader("movie"); }
    const std::optional<std::string> reason = queue.push(numbered_frame(0));
    ASSERT_TRUE(reason);
    EXPECT_EQ(*reason, "movie: stopped reading before the last frame");
}

TEST(FrameQueue, AReaderThatReachedTheEndMayLeave) {
    FrameQueue queue(1);
    {
        FrameQueue::Reader reader = queue.add_reader("store");
        EXPECT_FALSE(queue.push(numbered_frame(0)));
        queue.close();
        EXPECT_EQ(read_all(reader), count_to(1));
    }
    EXPECT_FALSE(queue.failure());
}

TEST(FrameQueue, WithoutReadersTheProducerNeverWaits) {
    FrameQueue queue(1);
    for (int n = 0; n < 10; ++n) EXPECT_FALSE(queue.push(numbered_frame(n)));
}

TEST(FrameQueue, ReadersEndWhenTheQueueIsDestroyed) {
    auto queue = std::make_unique<FrameQueue>(4);
    FrameQueue::Reader reader = queue->add_reader("store");
    EXPECT_FALSE(queue->push(numbered_frame(0)));
    std::vector<int> seen;
    std::thread thread([&] { seen = read_all(reader); });
    queue.reset();
    thread.join();
    EXPECT_EQ(seen, count_to(1));
}

}  // namespace
}  // namespace spheroscope
