// While a wall acts the integral of the volume controller is frozen: it does not wind up against a
// pressure that the wall causes.
#include "tests/reference/made_up_cells.hpp"

#include <gtest/gtest.h>

#include <string>

namespace spheroscope::test {
namespace {

class VolumeIntegral : public testing::TestWithParam<std::string_view> {
  protected:
    /// Integral after some steps of a cell that is 10 % too large.
    static double after_steps(std::string_view method_name, bool freeze) {
        const Model model = make_model(make_icosphere(42), {6.0});
        PartValues values;
        values.gamma_nN_per_um = 0.5;
        values.K_kPa = 5.0;
        values.T_I_s = 0.1;
        System system(model, make_parts(values), 1);
        std::vector<Vec3> x_um = turned_cells(model, std::vector<Vec3>{Vec3::Zero()}, 1);
        for (Vec3& x : x_um) x *= 1.03;
        State state = state_at(model, x_um);
        MethodParameters parameters;
        parameters.dt_s = 1e-3;
        parameters.linear_tolerance = 1e-8;
        const auto method = find_method(method_name)->make(parameters);
        for (int step = 0; step < 5; ++step)
            EXPECT_TRUE(method->advance(system, state, 1e9, freeze).accepted);
        return state.volume_integral_s[0];
    }
};

TEST_P(VolumeIntegral, DoesNotMoveWhileItIsFrozen) {
    EXPECT_EQ(after_steps(GetParam(), true), 0.0);
}

TEST_P(VolumeIntegral, GrowsWithTheStrainWhenItIsNot) {
    const double integral_s = after_steps(GetParam(), false);
    EXPECT_GT(integral_s, 0.0);
    EXPECT_LT(integral_s, 5 * 1e-3 * 0.1);  // at most the first strain, all the time
}

INSTANTIATE_TEST_SUITE_P(Methods, VolumeIntegral, testing::ValuesIn([] {
                             std::vector<std::string_view> names;
                             for (const MethodRow& row : all_methods()) names.push_back(row.name);
                             return names;
                         }()),
                         [](const auto& tested) { return std::string(tested.param); });

}  // namespace
}  // namespace spheroscope::test
