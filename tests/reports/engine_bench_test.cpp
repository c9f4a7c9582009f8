#include "engine/reports/engine_bench.hpp"
#include "engine/reports/machine.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <vector>

namespace spheroscope::reports {
namespace {

// The allocators of the sanitizers do not say what they gave out, and their checks change what
// takes how long.
#ifdef SPHEROSCOPE_SANITIZER_ALLOCATES
constexpr bool k_is_sanitized = true;
#else
constexpr bool k_is_sanitized = false;
#endif

double memory_MB(int cells, int nodes) {
    return run_bench({.cells = cells, .nodes = nodes, .threads = 1}, {.repetitions = {.most = 1}})
        .value()
        .memory_MB;
}

TEST(EngineBench, MemoryOfASizeDoesNotDependOnTheSizesBeforeIt) {
    if (k_is_sanitized) GTEST_SKIP() << "a sanitizer allocates";
    static_cast<void>(memory_MB(2, 42));  // what is made once in a process
    const double first_MB = memory_MB(13, 42);
    EXPECT_GT(first_MB, 0.1);
    EXPECT_GT(memory_MB(26, 42), first_MB);
    // arrays that grew for the larger one in between may keep a little less or more
    EXPECT_NEAR(memory_MB(13, 42), first_MB, 0.2 * first_MB) << "after a larger one";
}

TEST(EngineBench, MemoryGrowsAsTheCellsDo) {
    if (k_is_sanitized) GTEST_SKIP() << "a sanitizer allocates";
    const double few_MB = memory_MB(13, 42), many_MB = memory_MB(52, 42);
    EXPECT_GT(many_MB, 3.0 * few_MB);
    EXPECT_LT(many_MB, 6.0 * few_MB) << "of 52 cells more are inside, with twelve neighbours";
}

TEST(EngineBench, InDoublesTheKernelIsNearerToThePlainOne) {
    const BenchSize size{.cells = 2, .nodes = 42, .threads = 1};
    const BenchRow in_floats = run_bench(size, {.repetitions = {.most = 1}}).value();
    const BenchRow in_doubles = run_bench(size, {.repetitions = {.most = 1},
                                                 .precision = scene::Precision::double_precision})
                                    .value();
    EXPECT_GT(in_floats.force_error, 1e-9);
    EXPECT_LT(in_floats.force_error, 1e-4);
    EXPECT_LT(in_doubles.force_error, 1e-12);
}

TEST(EngineBench, StatesDoNotDependOnHowOftenAStepIsTimed) {
    const BenchSize size{.cells = 2, .nodes = 42, .threads = 1};
    const BenchRow once = run_bench(size, {.repetitions = {.most = 1}}).value();
    const BenchRow often = run_bench(size, {.repetitions = {.most = 9}}).value();
    ASSERT_EQ(once.steps.size(), often.steps.size());
    ASSERT_FALSE(once.steps.empty());
    for (std::size_t k = 0; k < once.steps.size(); ++k) {
        EXPECT_EQ(once.steps[k].state_hash, often.steps[k].state_hash) << once.steps[k].method;
        EXPECT_EQ(once.steps[k].dt_s, often.steps[k].dt_s) << once.steps[k].method;
    }
}

TEST(EngineBench, NoRepetitionIsFree) {
    if (k_is_sanitized) GTEST_SKIP() << "a sanitizer checks some code more than other code";
    const BenchRow row =
        run_bench({.cells = 13, .nodes = 162, .threads = 1}, {.repetitions = {.most = 9}}).value();
    double terms_ms = 0.0;
    for (const BenchTerm& term : row.terms) terms_ms += term.time.cpu_ms;
    // Forces take twice as long as their terms without contacts, and hardly anything if they were
    // taken from the repetition before; with the stiffness three times as long, and as long if it
    // was. The bounds leave room for what else the machine does.
    EXPECT_GT(row.force.cpu_ms, 0.5 * terms_ms);
    EXPECT_GT(row.stiffness.cpu_ms, 1.5 * row.force.cpu_ms);
}

TEST(EngineBench, AStopLeavesNoHalfRow) {
    const std::atomic<bool> stop{true};
    EXPECT_FALSE(
        run_bench({.cells = 2, .nodes = 42, .threads = 1}, {.repetitions = {.stop = &stop}}));
}

}  // namespace
}  // namespace spheroscope::reports
