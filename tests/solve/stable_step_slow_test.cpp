// The estimate of the largest stable step against a ladder of steps that are tried.
#include "engine/solve/explicit_bound.hpp"
#include "tests/reference/made_up_cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace spheroscope::test {
namespace {

// As `spheroscope stability --steps` asks for.
constexpr double k_least_of_ladder = 0.7, k_most_of_ladder = 1.0;

struct Rig {
    Cluster cells;
    PartValues values;
};

/// The largest step that the program lets through over the largest one, on a ladder with rungs of
/// 3 %, with which the velocities do not grow in 300 steps.
double limit_over_ladder(const Rig& rig, double settled_s) {
    System system(rig.cells.model, make_parts(rig.values), 1);
    State start = state_at(rig.cells.model, rig.cells.x_um);
    MethodParameters settle;
    settle.dt_s = 1e-3;
    settle.tolerance_um = 6e-3;
    const auto implicit = find_method("linearly_implicit")->make(settle);
    EXPECT_TRUE(advance_until(*implicit, system, start, settled_s).accepted);
    EXPECT_FALSE(system.evaluate(start.x_um, start.volume_integral_s, 0.0));
    FastestMode mode;
    const double limit_s = ExplicitBound::k_largest_dt_times_rate / mode.rate_per_s(system);
    double stable_s = 0.0;
    for (double dt_s = 0.65 * limit_s;; dt_s *= 1.03) {
        State state = start;
        state.has_velocity = false;
        MethodParameters parameters;
        parameters.dt_s = dt_s;
        parameters.stable_step = StableStep::ignore;
        const auto method = find_method("forward_euler")->make(parameters);
        double early = 0.0, late = 0.0;
        bool is_stable = true;
        for (int step = 0; step < 300 && is_stable; ++step) {
            is_stable = method->advance(system, state, 1e9, false).accepted;
            double& largest = step < 30 ? early : late;
            if (step == 29 || step == 299)
                for (const Vec3& v : state.v_um_per_s) largest = std::max(largest, v.norm());
        }
        if (!is_stable || late > 2.0 * early) break;
        stable_s = dt_s;
    }
    return limit_s / stable_s;
}

TEST(StableStep, IsPredictedWithinAFewPercentOfTheLadder) {
    for (const double omega : {0.5, 1.0})
        for (const double E_kPa : {0.3125, 20.0, 320.0}) {
            Rig rig{make_doublet(162, 7, 9.0, 9.0, -0.2), case_a_values()};
            rig.values.E_kPa = E_kPa;
            rig.values.T_I_s = 0.115;
            rig.values.T_d_s = 1.15;
            rig.values.contact = adhesive_law(omega, 0.3, 2.0, 0.0);
            const double ratio = limit_over_ladder(rig, 2.0);
            EXPECT_GE(ratio, k_least_of_ladder) << omega << " " << E_kPa;
            EXPECT_LE(ratio, k_most_of_ladder) << omega << " " << E_kPa;
            RecordProperty("ratio", std::to_string(ratio));
            std::printf("omega %g, E %g: limit / ladder = %.3f\n", omega, E_kPa, ratio);
        }
}

TEST(StableStep, OfALoneStiffCellIsPredictedToo) {
    Rig rig{Cluster{make_model(make_icosphere(162), {9.0}), {}}, case_a_values()};
    rig.cells.x_um = turned_cells(rig.cells.model, std::vector<Vec3>{Vec3::Zero()}, 3, 0.02);
    rig.values.E_kPa = 1280.0;
    rig.values.contact.reset();
    rig.values.contact_friction.reset();
    const double ratio = limit_over_ladder(rig, 0.5);
    EXPECT_GE(ratio, k_least_of_ladder);
    EXPECT_LE(ratio, k_most_of_ladder);
    std::printf("lone cell: limit / ladder = %.3f\n", ratio);
}

}  // namespace
}  // namespace spheroscope::test
