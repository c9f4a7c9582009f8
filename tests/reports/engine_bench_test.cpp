#include "engine/reports/engine_bench.hpp"

#include <gtest/gtest.h>

namespace spheroscope::reports {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool k_counts_memory = false;  // their allocators do not say
#else
constexpr bool k_counts_memory = true;
#endif

double memory_MB(int cells, int nodes) {
    return run_bench({.cells = cells, .nodes = nodes, .threads = 1}, {.repetitions = 1}).memory_MB;
}

TEST(EngineBench, MemoryOfASizeDoesNotDependOnTheSizesBeforeIt) {
    if (!k_counts_memory) GTEST_SKIP();
    static_cast<void>(memory_MB(2, 42));  // what is made once in a process
    const double first_MB = memory_MB(13, 42);
    EXPECT_GT(first_MB, 0.1);
    EXPECT_GT(memory_MB(26, 42), first_MB);
    // arrays that grew for the larger one in between may keep a little less or more
    EXPECT_NEAR(memory_MB(13, 42), first_MB, 0.2 * first_MB) << "after a larger one";
}

TEST(EngineBench, MemoryGrowsAsTheCellsDo) {
    if (!k_counts_memory) GTEST_SKIP();
    const double few_MB = memory_MB(13, 42), many_MB = memory_MB(52, 42);
    EXPECT_GT(many_MB, 3.0 * few_MB);
    EXPECT_LT(many_MB, 6.0 * few_MB) << "of 52 cells more are inside, with twelve neighbours";
}

TEST(EngineBench, InDoublesTheKernelIsNearerToThePlainOne) {
    const BenchSize size{.cells = 2, .nodes = 42, .threads = 1};
    const BenchRow in_floats = run_bench(size, {.repetitions = 1});
    const BenchRow in_doubles =
        run_bench(size, {.repetitions = 1, .precision = scene::Precision::double_precision});
    EXPECT_GT(in_floats.force_error, 1e-9);
    EXPECT_LT(in_floats.force_error, 1e-4);
    EXPECT_LT(in_doubles.force_error, 1e-12);
}

}  // namespace
}  // namespace spheroscope::reports
