#include "engine/reports/engine_bench.hpp"
#include "engine/reports/machine.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace spheroscope::reports {
namespace {

/// The allocators of the sanitizers do not say what they gave out.
bool counts_memory() {
    const double before_MB = allocated_MB();
    const std::vector<char> megabytes(4'000'000, 'x');
    return allocated_MB() - before_MB > 1e-6 * static_cast<double>(megabytes.size()) / 2;
}

double memory_MB(int cells, int nodes) {
    return run_bench({.cells = cells, .nodes = nodes, .threads = 1}, {.repetitions = 1}).memory_MB;
}

TEST(EngineBench, MemoryOfASizeDoesNotDependOnTheSizesBeforeIt) {
    if (!counts_memory()) GTEST_SKIP();
    static_cast<void>(memory_MB(2, 42));  // what is made once in a process
    const double first_MB = memory_MB(13, 42);
    EXPECT_GT(first_MB, 0.1);
    EXPECT_GT(memory_MB(26, 42), first_MB);
    // arrays that grew for the larger one in between may keep a little less or more
    EXPECT_NEAR(memory_MB(13, 42), first_MB, 0.2 * first_MB) << "after a larger one";
}

TEST(EngineBench, MemoryGrowsAsTheCellsDo) {
    if (!counts_memory()) GTEST_SKIP();
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
