// The method that looks for end states against the end of a motion.
#include "tests/reference/made_up_cells.hpp"

#include <gtest/gtest.h>

namespace spheroscope::test {
namespace {

struct End {
    double contact_area_um2 = 0.0;
    int steps = 0;
};

End end_of(std::string_view method_name, double E_kPa, bool exact_volume, double dt_max_s,
           int most_steps, double end_s) {
    PartValues values = case_a_values();
    values.E_kPa = E_kPa;
    values.T_I_s = 0.115;
    if (exact_volume)
        values.exact_volume = true;
    else
        values.T_d_s = 1.15;
    const Cluster cells = make_doublet(162, 7, 9.0, 9.0, -0.2);
    System system(cells.model, make_parts(values), 1);
    State state = state_at(cells.model, cells.x_um);
    MethodParameters parameters;
    parameters.dt_s = 4e-3;
    parameters.tolerance_um = 6e-3;
    parameters.dt_max_s = dt_max_s;
    const auto method = find_method(method_name)->make(parameters);
    End end;
    while (end.steps < most_steps && state.time_s < end_s) {
        const StepOutcome outcome = method->advance(system, state, end_s, false);
        if (!outcome.accepted) {
            ADD_FAILURE() << outcome.trouble->text();
            break;
        }
        EXPECT_LE(outcome.largest_displacement_um, parameters.displacement_bound_um);
        ++end.steps;
    }
    for (const Contacts::Group& group : system.contacts().groups)
        for (const ContactPair& pair : Contacts::pairs_of(group))
            end.contact_area_um2 += pair.area_um2;
    return end;
}

TEST(Equilibrium, OfADoubletHasTheContactAreaOfTheMotionsEnd) {
    for (const double E_kPa : {20.0, 320.0}) {
        const End motion = end_of("linearly_implicit", E_kPa, false, 1.0, 10000, 150.0);
        const End direct = end_of("equilibrium", E_kPa, true, 1e6, 105, 1e12);
        std::printf("E %g: motion %d steps, %.3f um^2; equilibrium %d steps, %.3f um^2\n", E_kPa,
                    motion.steps, motion.contact_area_um2, direct.steps, direct.contact_area_um2);
        EXPECT_NEAR(direct.contact_area_um2 / motion.contact_area_um2, 1.0, 1e-3);
        EXPECT_LT(3 * direct.steps, 2 * motion.steps);
    }
}

}  // namespace
}  // namespace spheroscope::test
