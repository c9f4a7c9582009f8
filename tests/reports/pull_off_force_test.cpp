// The force that parts two cells: what it is near, and what is refused.

#include "engine/base/error.hpp"
#include "engine/reports/pull_off_force.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>

namespace spheroscope::reports {
namespace {

const std::string k_scene = SPHEROSCOPE_SOURCE_DIR "/scenes/claims/pull_off.toml";

/// The scene on a coarse mesh, hardly relaxed.
std::vector<PullOff> pull(std::vector<scene::Override> changes, const PullOffOptions& options) {
    changes.insert(changes.begin(), {{"cells.nodes", "162"}, {"stage[0].duration", "3 s"}});
    return measure_pull_off(k_scene, changes, options);
}

std::string refusal(const std::vector<scene::Override>& changes) {
    try {
        static_cast<void>(pull(changes, {}));
    } catch (const Error& error) {
        return error.what();
    }
    return "nothing was said";
}

TEST(PullOffForce, IsNearPiRWAndGrowsWithTheAdhesion) {
    const PullOffOptions fast{.rate_nN_per_s = 1.0};
    const std::vector<PullOff> strong = pull({}, fast);
    const std::vector<PullOff> weak = pull({{"contact.adhesion.omega", "0.25"}}, fast);
    ASSERT_EQ(strong.size(), 5U);
    for (std::size_t k = 0; k < strong.size(); ++k) {
        const PullOff& row = strong[k];
        EXPECT_EQ(row.problem, "") << row.variant;
        EXPECT_DOUBLE_EQ(row.Et_over_gamma, 0.5 * std::pow(4.0, static_cast<double>(k)));
        EXPECT_GT(row.over_pi_R_W, 0.3) << row.variant;
        EXPECT_LT(row.over_pi_R_W, 2.5) << row.variant;  // fast, on a mesh whose rims catch
        EXPECT_GT(row.force_nN, 1.3 * weak[k].force_nN) << row.variant;
    }
    const Plot plot = pull_off_plot(strong);
    ASSERT_EQ(plot.panels.size(), 1U);
    EXPECT_EQ(plot.panels[0].series[0].y[1], strong[1].over_pi_R_W);
}

TEST(PullOffForce, SaysWhatItWants) {
    EXPECT_NE(refusal({{"cells.centres", "[[0, 0, -9.05, 9], [0, 0, 9.05, 9], [0, 0, 27.15, 9]]"}})
                  .find("wants two cells"),
              std::string::npos);
    EXPECT_NE(refusal({{"cells.centres", "[[0, 0, -9.05, 9], [0, 0, 9.05, 8]]"}})
                  .find("wants cells of one radius"),
              std::string::npos);
}

TEST(PullOffForce, WantsAMotionInTime) {
    // The scene with a method that looks for an end state, which needs another controller.
    std::stringstream text;
    text << std::ifstream(k_scene).rdbuf();
    std::string scene = text.str();
    const std::string pid = "controller = \"pid\"\nK = \"5 kPa\"";
    ASSERT_NE(scene.find(pid), std::string::npos);
    scene.replace(scene.find(pid), pid.size(), "controller = \"exact\"");
    const std::string file = testing::TempDir() + "pull_off_end_state.toml";
    std::ofstream(file) << scene << "\n[method]\nname = \"equilibrium\"\n";
    try {
        static_cast<void>(measure_pull_off(file, {}, {}));
        FAIL() << "nothing was said";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("wants a method whose motion is one in time"),
                  std::string::npos)
            << error.what();
    }
    std::remove(file.c_str());
}

TEST(PullOffForce, OfCellsThatDoNotTouchIsAProblemAndNotZero) {
    for (const PullOff& row : pull({{"cells.centres", "[[0, 0, -12, 9], [0, 0, 12, 9]]"}}, {}))
        EXPECT_NE(row.problem.find("do not touch"), std::string::npos) << row.problem;
}

TEST(PullOffForce, EndsWithAReasonWhenItIsStopped) {
    const std::atomic<bool> stop{true};
    for (const PullOff& row : pull({}, {.stop = &stop}))
        EXPECT_NE(row.problem.find("stopped"), std::string::npos);
}

}  // namespace
}  // namespace spheroscope::reports
