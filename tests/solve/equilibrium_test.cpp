// The controller that keeps the volume as a constraint.
#include "tests/reference/made_up_cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace spheroscope::test {
namespace {

SystemParts exact_parts() {
    PartValues values = case_a_values();
    values.T_I_s = 1.0;
    values.exact_volume = true;
    return make_parts(values);
}

struct End {
    double largest_strain = 0.0;  ///< of a volume, at the start of any step but the first
    double last_strain = 0.0;
    int steps = 0;
};

/// Two cells of 42 nodes and 0.2 um between them, until the forces are below a bound.
End end_of(std::string_view method_name, double dt_max_s, double force_nN, int most_steps) {
    const Cluster cells = make_doublet(42, 7, 9.0, 9.0, -0.2);
    System system(cells.model, exact_parts(), 1);
    State state = state_at(cells.model, cells.x_um);
    MethodParameters parameters;
    parameters.dt_s = 4e-3;
    parameters.tolerance_um = 6e-3;
    parameters.dt_max_s = dt_max_s;
    const auto method = find_method(method_name)->make(parameters);
    End end;
    while (end.steps < most_steps) {
        const StepOutcome outcome = method->advance(system, state, 1e12, false);
        if (!outcome.accepted) {
            ADD_FAILURE() << outcome.trouble->text();
            break;
        }
        EXPECT_LE(outcome.largest_displacement_um, parameters.displacement_bound_um);
        end.last_strain = 0.0;
        for (int cell = 0; cell < 2; ++cell)
            end.last_strain = std::max(
                end.last_strain,
                std::abs(system.parts().cytosol->volume_strain(system.configuration(), cell)));
        if (end.steps > 0) end.largest_strain = std::max(end.largest_strain, end.last_strain);
        ++end.steps;
        if (outcome.force_rms_nN < force_nN) break;
    }
    return end;
}

TEST(ExactVolume, IsKeptInEveryStepAndToTheLastDigitsAtRest) {
    for (const MethodRow& row : all_methods()) {
        if (!row.holds_exact_volume) continue;
        const End exact = end_of(row.name, 1.0, 1e-3, 400);
        EXPECT_LT(exact.largest_strain, 1e-4) << row.name;
        EXPECT_LT(exact.last_strain, 2e-6) << row.name;
    }
}

TEST(ExactVolume, IsHeldWhileAWallActsToo) {
    // It is no integral, so it is not frozen, and it cannot wind up.
    const Model model = make_model(make_icosphere(42), {6.0});
    System system(model, exact_parts(), 1);
    std::vector<Vec3> x_um = turned_cells(model, std::vector<Vec3>{Vec3::Zero()}, 1);
    for (Vec3& x : x_um) x = 1.02 * x.cwiseProduct(Vec3(1.2, 1.0, 1.0 / 1.2));
    State state = state_at(model, x_um);
    MethodParameters parameters;
    parameters.dt_s = 1e-3;
    parameters.tolerance_um = 6e-3;
    const auto method = find_method("linearly_implicit")->make(parameters);
    for (int step = 0; step < 60; ++step)
        ASSERT_TRUE(method->advance(system, state, 1e9, true).accepted);
    const double volume_um3 = geometry_of(model, state.x_um, Need::volumes).volume_um3[0];
    EXPECT_NEAR(volume_um3 / model.target_volume_um3[0], 1.0, 1e-5);
}

}  // namespace
}  // namespace spheroscope::test
