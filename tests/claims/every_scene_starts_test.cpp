#include "tests/claims/scene_run.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace spheroscope::test {
namespace {

/// Scenes of many cells, made small: twelve cells of 42 nodes. So few beads jam early.
std::vector<std::string> large_scenes() {
    std::vector<std::string> names = scene_files("tour");
    for (const std::string& name : scene_files("paper")) names.push_back(name);
    return names;
}

class LargeScene : public testing::TestWithParam<std::string> {};

TEST_P(LargeScene, PacksItsBeadsAndTakesThreeSteps) {
    const SceneRun run = run_scene(
        GetParam(),
        {{"cells.nodes", "42"}, {"cells.count", "12"}, {"stage[0].packing_fraction", "0.4"}}, 3);
    EXPECT_EQ(run.result.verdict, RunVerdict::stopped) << run.result.message;
    EXPECT_EQ(run.result.work.steps, 3);
    EXPECT_GT(run.result.time_s, 0.0);
    ASSERT_FALSE(run.frames.empty());
    EXPECT_EQ(run.last().header->fields.size(), run.scene.measures.fields.size());
}

INSTANTIATE_TEST_SUITE_P(Scenes, LargeScene, testing::ValuesIn(large_scenes()),
                         [](const auto& name) {
                             std::string word = name.param.substr(0, name.param.size() - 5);
                             for (char& c : word)
                                 if (c == '/') c = '_';
                             return word;
                         });

}  // namespace
}  // namespace spheroscope::test
