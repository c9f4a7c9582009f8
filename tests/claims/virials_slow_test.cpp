// C-19: at rest no force is left to hold the cells against anything, so the stresses between them
// add up to nothing over the volume, and from inside each cell one sees what its contacts do to it.
#include "tests/claims/scene_run.hpp"

#include <gtest/gtest.h>

namespace spheroscope::test {
namespace {

class VirialsAtRest : public testing::TestWithParam<const char*> {};

TEST_P(VirialsAtRest, OfThirteenCellsAddUpToNothing) {
    const SceneRun run = run_scene("bench/ball_13.toml", {{"cells.nodes", "162"},
                                                          {"stage[0].duration", "200 s"},
                                                          {"stage[0].every", "200 s"},
                                                          {"method.tolerance", "20 nm"},
                                                          {"method.dt_max", "5 s"},
                                                          {"contact.law", GetParam()}});
    ASSERT_EQ(run.result.verdict, RunVerdict::finished) << run.result.message;
    const Totals& totals = run.result.totals;
    EXPECT_LT(totals.normal_speed_rms_um_per_s, 1e-3) << "at rest";
    EXPECT_GT(totals.sigma_h_size_kPa, 1e-3) << "there is stress to be summed";
    EXPECT_LT(totals.virial_defect, 0.01);
    EXPECT_LT(totals.virial_identity, 0.01);
    // They did not do so on the way.
    EXPECT_GT(run.frames.front()->totals.virial_defect, 0.1);
}

INSTANTIATE_TEST_SUITE_P(Laws, VirialsAtRest, testing::Values("traction", "variational"),
                         [](const auto& law) { return std::string(law.param); });

}  // namespace
}  // namespace spheroscope::test
