// Every scene of scenes/claims states in [expect] what must come out; here all of them are held to
// it.

#include "engine/run/expectations.hpp"
#include "tests/claims/scene_run.hpp"

#include <gtest/gtest.h>

namespace spheroscope::test {
namespace {

class ClaimScene : public testing::TestWithParam<std::string> {};

TEST_P(ClaimScene, MeetsWhatItExpects) {
    const SceneRun run = run_scene(GetParam());
    EXPECT_EQ(run.result.verdict, RunVerdict::finished) << run.result.message;
    const std::vector<Expectation> rows = check_expectations(run.scene, run.last());
    EXPECT_FALSE(rows.empty()) << "the scene claims nothing";
    for (const Expectation& row : rows)
        EXPECT_TRUE(row.met) << row.measure << " = " << row.value << " " << row.unit << ", wanted "
                             << row.min << " ... " << row.max;
}

INSTANTIATE_TEST_SUITE_P(Scenes, ClaimScene, testing::ValuesIn(scene_files("claims")),
                         [](const auto& name) {
                             const auto begin = name.param.find('/') + 1;
                             return name.param.substr(begin, name.param.size() - begin - 5);
                         });

}  // namespace
}  // namespace spheroscope::test
