// What the program lets through as a step of forward Euler, beside where steps blow up, on every
// scene of scenes/bench: never more, and not so much less that many steps which hold are refused.
#include "engine/reports/step_ladder.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <iostream>

namespace spheroscope::reports {
namespace {

/// The steps that hold and do not then lie within 5 % of each other.
constexpr int k_bisections = 3;

class StepLadderOfBench : public testing::TestWithParam<const char*> {};

TEST_P(StepLadderOfBench, LetsThroughSevenTenthsOfTheLargestStepThatHoldsUpToAllOfIt) {
    const scene::Scene scene = scene::load_scene(
        fmt::format("{}/scenes/bench/{}.toml", SPHEROSCOPE_SOURCE_DIR, GetParam()), {});
    const std::vector<StepLadder> ladders =
        climb_steps(scene, {.threads = 1, .n_bisections = k_bisections});
    ASSERT_FALSE(ladders.empty());
    for (const StepLadder& ladder : ladders) {
        std::cout << fmt::format("{:<14} {}: holds {:.4g} s, not {:.4g} s, let through {:.4g} s: "
                                 "{:.3f}\n",
                                 GetParam(), ladder.method->name, ladder.largest_stable_s,
                                 ladder.smallest_unstable_s, ladder.estimate_s,
                                 ladder.estimate_over_stable());
        EXPECT_TRUE(is_estimate_good(ladder)) << ladder.estimate_over_stable();
        EXPECT_LT(ladder.smallest_unstable_s, 1.06 * ladder.largest_stable_s) << "bisected";
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, StepLadderOfBench,
                         testing::Values("stiff_cell", "doublet_stiff", "doublet_soft", "ball_13",
                                         "aggregate_75"),
                         [](const auto& tested) { return std::string(tested.param); });

}  // namespace
}  // namespace spheroscope::reports
