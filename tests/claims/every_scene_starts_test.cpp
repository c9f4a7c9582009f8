#include "tests/claims/scene_run.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace spheroscope::test {
namespace {

/// Scenes that no other test runs to their end in every build.
std::vector<std::string> other_scenes() {
    std::vector<std::string> names;
    for (const char* folder : {"tour", "paper", "bench", "stress"})
        for (const std::string& name : scene_files(folder)) names.push_back(name);
    return names;
}

/// Cells of 42 nodes; of a packing twelve, and loose: so few beads jam early.
std::vector<scene::Override> made_small(const std::string& name) {
    std::vector<scene::Override> changes{{"cells.nodes", "42"}};
    const scene::Scene scene =
        scene::load_scene(std::string(SPHEROSCOPE_SOURCE_DIR "/scenes/") + name, {});
    if (scene.cells.arrangement == scene::Arrangement::packing) {
        changes.push_back({"cells.count", "12"});
        changes.push_back({"stage[0].packing_fraction", "0.4"});
    }
    return changes;
}

class OtherScene : public testing::TestWithParam<std::string> {};

TEST_P(OtherScene, PutsItsCellsAndTakesThreeSteps) {
    const SceneRun run = run_scene(GetParam(), made_small(GetParam()), 3);
    EXPECT_EQ(run.result.verdict, RunVerdict::stopped) << run.result.message;
    EXPECT_EQ(run.result.work.steps, 3);
    EXPECT_GT(run.result.time_s, 0.0);
    const bool has_outputs =
        std::any_of(run.scene.stages.begin(), run.scene.stages.end(),
                    [](const auto& stage) { return stage.every_s > 0.0 || stage.frames > 0; });
    ASSERT_EQ(run.frames.empty(), !has_outputs);
    if (has_outputs) {
        EXPECT_EQ(run.last().header->fields.size(), run.scene.measures.fields.size());
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, OtherScene, testing::ValuesIn(other_scenes()),
                         [](const auto& name) {
                             std::string word = name.param.substr(0, name.param.size() - 5);
                             for (char& c : word)
                                 if (c == '/') c = '_';
                             return word;
                         });

}  // namespace
}  // namespace spheroscope::test
