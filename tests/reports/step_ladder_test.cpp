#include "engine/reports/step_ladder.hpp"
#include "tests/reports/stretched_cell.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <limits>

namespace spheroscope::reports {
namespace {

bool is_good(double estimate_s, double stable_s) {
    StepLadder ladder;
    ladder.estimate_s = estimate_s;
    ladder.largest_stable_s = stable_s;
    return is_estimate_good(ladder);
}

TEST(StepLadder, AnEstimateIsGoodFromSevenTenthsOfTheStepThatHoldsUpToAllOfIt) {
    EXPECT_TRUE(is_good(0.92, 1.0));
    EXPECT_TRUE(is_good(0.701, 1.0));
    EXPECT_TRUE(is_good(1.0, 1.0));
    EXPECT_FALSE(is_good(0.699, 1.0)) << "steps that hold would be refused";
    EXPECT_FALSE(is_good(1.01, 1.0)) << "a step that blows up would not be refused";
}

TEST(StepLadder, AnEstimateWithoutAStepThatHoldsIsNotGood) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(is_good(1.0, none));
    EXPECT_FALSE(is_good(none, 1.0));
}

TEST(StepLadder, ThatIsStoppedHasNoTrialOfTheStepThatWasStopped) {
    const scene::Scene scene =
        scene::parse_scene(stretched_cell_text("0.032 s", "dt = \"4 ms\"\n"), "cell.toml");
    const std::atomic<bool> stop{true};
    const std::vector<StepLadder> ladders = climb_steps(scene, {.threads = 1, .stop = &stop});
    ASSERT_EQ(ladders.size(), 1U) << "nothing is begun after a stop";
    EXPECT_TRUE(ladders[0].is_interrupted);
    EXPECT_TRUE(ladders[0].trials.empty());
    for (const StepLadder& ladder : climb_steps(scene, {.threads = 1, .n_bisections = 0}))
        EXPECT_FALSE(ladder.is_interrupted);
}

}  // namespace
}  // namespace spheroscope::reports
