// Lone cells on their way, frame by frame; [expect] of the scenes holds them to their ends.

#include "tests/claims/scene_run.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace spheroscope::test {
namespace {

double volume_strain(const Snapshot& frame, double target_um3) {
    return double{frame.volume_um3[0]} / target_um3 - 1.0;
}

TEST(Breathing, BeginsAtTheRateThatCortexAndMediumAllowAndSlowsDownExponentially) {
    const SceneRun run = run_scene("claims/breathing.toml");
    const double R = 9.0, pressure_step = 0.01, eta_t = 0.2, eta_f = 0.05, Et = 4.0, gamma = 0.5;
    const double V = 4.0 / 3.0 * std::numbers::pi * R * R * R;
    // Radial strain s: s' = (D - b s) / a with the friction a of cortex and medium per area and
    // radius.
    const double a = R * (2.0 * eta_t / (R * R) + 1.5 * eta_f / R);
    const double b = (3.0 * Et - 2.0 * gamma) / R;
    ASSERT_GT(run.frames.size(), 41U);
    for (const std::size_t k : {std::size_t{2}, std::size_t{4}, std::size_t{10}, std::size_t{20}}) {
        const double t = run.frames[k]->time_s;
        SCOPED_TRACE(t);
        const double s = pressure_step / b * (1.0 - std::exp(-b * t / a));
        const double measured = volume_strain(*run.frames[k], V) / 3.0;
        // 0.5 % of the mesh, 2 s of geometry that the linear form leaves out, and half a step of
        // 2 ms at first order.
        EXPECT_NEAR(measured / s, 1.0, 0.005 + 2.0 * s + 0.001 * b / a);
    }
}

TEST(VolumeStep, SwingsWithThePeriodOfTheControllersRoots) {
    const SceneRun run = run_scene("claims/volume_step.toml");
    const double R = 9.0;
    const double target = 1.01 * 4.0 / 3.0 * std::numbers::pi * R * R * R;
    // Zero crossings of V - V*, linear between frames; two in a row are half a period apart.
    std::vector<double> crossing_s;
    for (std::size_t k = 1; k < run.frames.size() && crossing_s.size() < 4; ++k) {
        const double before = volume_strain(*run.frames[k - 1], target);
        const double now = volume_strain(*run.frames[k], target);
        if (before * now < 0.0)
            crossing_s.push_back(run.frames[k - 1]->time_s +
                                 before / (before - now) *
                                     (run.frames[k]->time_s - run.frames[k - 1]->time_s));
    }
    ASSERT_EQ(crossing_s.size(), 4U);
    const double period_s = 2.0 / 3.0 * (crossing_s[3] - crossing_s[0]);
    EXPECT_NEAR(period_s, 2.0 * std::numbers::pi / 2.695, 0.05 * 2.33);
}

}  // namespace
}  // namespace spheroscope::test
