// The loading of Appendix G on thirteen cells: what must hold at rest under the bead.
#include "engine/run/expectations.hpp"
#include "tests/claims/scene_run.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace spheroscope::test {
namespace {

TEST(UnderTheBead, ForcesOfBeadHullAndCellsSumToZero) {
    const SceneRun run = run_scene("tour/under_the_bead.toml");
    ASSERT_EQ(run.result.verdict, RunVerdict::finished) << run.result.message;
    EXPECT_EQ(run.result.outcome, "rest");
    const Totals& totals = run.result.totals;
    EXPECT_NEAR(totals.probe_force_nN, 15.0, 0.015);
    EXPECT_NEAR(totals.hull_force_nN, 15.0, 0.03);
    EXPECT_LT(totals.load_imbalance, 1e-3);
    EXPECT_LT(totals.volume_error, 1e-3);
    // sigma_h is of the forces between cells, as printed. The bead and its hull press from outside,
    // so its sum over the volume is no zero but pressure: half of the sum of its sizes here.
    EXPECT_GT(totals.virial_defect, 0.1);
    EXPECT_LT(totals.sigma_h_mean_kPa, 0.0);
    for (const Expectation& expectation : check_expectations(run.scene, totals))
        EXPECT_TRUE(expectation.met) << expectation.measure << " = " << expectation.value;

    // Force over way: it rises from zero and never overshoots by more than the drag allows.
    double last_way_um = -1.0;
    int n_points = 0;
    for (const SnapshotPtr& frame : run.frames) {
        if (std::isnan(frame->totals.probe_force_nN)) continue;
        ++n_points;
        EXPECT_GT(frame->totals.probe_way_um, last_way_um - 0.05);
        EXPECT_LT(frame->totals.probe_force_nN, 16.0);
        last_way_um = frame->totals.probe_way_um;
        EXPECT_TRUE(frame->load.probe.acts());
        ASSERT_NE(frame->load.hull, nullptr);
    }
    EXPECT_GT(n_points, 5);
    EXPECT_GT(last_way_um, 0.5);
}

}  // namespace
}  // namespace spheroscope::test
