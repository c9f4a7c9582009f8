#include "engine/base/priority.hpp"

#include <gtest/gtest.h>

#include <sys/resource.h>
#include <thread>
#include <unistd.h>

namespace spheroscope {
namespace {

int niceness() { return getpriority(PRIO_PROCESS, static_cast<id_t>(gettid())); }

TEST(LetOtherThreadsFirst, HoldsForTheThreadAndThoseItStartsAndForNoOther) {
    const int before = niceness();
    int own = 0, of_child = 0;
    std::thread([&] {
        let_other_threads_first();
        own = niceness();
        std::thread([&] { of_child = niceness(); }).join();
    }).join();
    EXPECT_EQ(own, 10);
    EXPECT_EQ(of_child, 10);
    EXPECT_EQ(niceness(), before);
}

}  // namespace
}  // namespace spheroscope
