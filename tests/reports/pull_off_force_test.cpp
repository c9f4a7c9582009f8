// The force that parts two cells: what it is near, and what is refused.

#include "engine/base/error.hpp"
#include "engine/reports/pull_off_force.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace spheroscope::reports {
namespace {

class PullOffForce : public testing::Test {
  protected:
    PullOffForce() {
        std::filesystem::create_directories(folder_);
        std::ofstream(file_) << R"(
[cells]
arrangement = "centres"
nodes = 162
centres = [[0, 0, "-9.05 um", "9 um"], [0, 0, "9.05 um", "9 um"]]
[cortex.elastic]
E = "20 kPa"
[cortex.tension]
gamma = "0.5 nN/um"
[cortex.viscosity]
eta = "1 kPa s"
[cytosol]
[medium]
[contact]
omega_reading = "text"
[contact.adhesion]
omega = "0.5 nN/um"
[contact.friction]
normal = "0.05 kPa s/um"
tangential = "0.05 kPa s/um"
[[stage]]
kind = "relax"
duration = "3 s"
[[variant]]
name = "weak"
set = ["contact.adhesion.omega=0.25 nN/um"]
[[variant]]
name = "strong"
set = ["contact.adhesion.omega=0.5 nN/um"]
)";
    }
    ~PullOffForce() override { std::filesystem::remove_all(folder_); }

    [[nodiscard]] std::string refusal(const std::vector<scene::Override>& changes) const {
        try {
            static_cast<void>(measure_pull_off(file_, changes, {}));
        } catch (const Error& error) {
            return error.what();
        }
        return "nothing was said";
    }

    std::string folder_ = testing::TempDir() + "pull_off_force";
    std::string file_ = folder_ + "/pair.toml";
};

TEST_F(PullOffForce, IsNearPiRWAndGrowsWithTheAdhesion) {
    const std::vector<PullOff> rows = measure_pull_off(file_, {}, {.rate_nN_per_s = 0.5});
    ASSERT_EQ(rows.size(), 2U);
    for (const PullOff& row : rows) {
        EXPECT_EQ(row.problem, "");
        EXPECT_DOUBLE_EQ(row.Et_over_gamma, 8.0);
        EXPECT_GT(row.area_at_rest_um2, 1.0);
        EXPECT_GT(row.over_pi_R_W, 0.3) << row.variant;
        EXPECT_LT(row.over_pi_R_W, 1.5) << row.variant;
    }
    EXPECT_EQ(rows[0].variant, "weak");
    EXPECT_GT(rows[1].force_nN, 1.5 * rows[0].force_nN);

    const Plot plot = pull_off_plot(rows);
    ASSERT_EQ(plot.panels.size(), 1U);
    EXPECT_EQ(plot.panels[0].series[0].y[1], rows[1].over_pi_R_W);
}

TEST_F(PullOffForce, SaysWhatItWants) {
    EXPECT_NE(refusal({{"cells.centres", "[[0, 0, -9.05, 9], [0, 0, 9.05, 9], [0, 0, 27.15, 9]]"}})
                  .find("wants two cells"),
              std::string::npos);
    EXPECT_NE(refusal({{"cells.centres", "[[0, 0, -9.05, 9], [0, 0, 9.05, 8]]"}})
                  .find("wants cells of one radius"),
              std::string::npos);
}

TEST_F(PullOffForce, EndsWithAReasonWhenItIsStopped) {
    const std::atomic<bool> stop{true};
    const std::vector<PullOff> rows = measure_pull_off(file_, {}, {.stop = &stop});
    for (const PullOff& row : rows) EXPECT_NE(row.problem.find("stopped"), std::string::npos);
}

}  // namespace
}  // namespace spheroscope::reports
