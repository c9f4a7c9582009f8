// The same cells after the same time, by an independent program with its own integrator
// (tests/reference/python), and by methods of the engine.
#include "tests/reference_twin/twin_file.hpp"

#include <gtest/gtest.h>

namespace spheroscope::test {
namespace {

/// Of volumes, areas, stresses and the way that the nodes have gone.
constexpr double k_tolerance = 1e-3;

class TwinMotion
    : public testing::TestWithParam<std::tuple<std::string, std::pair<std::string, double>>> {};

TEST_P(TwinMotion, EndsWhereTheEnginesDoes) {
    const TwinProblem twin{std::get<0>(GetParam())};
    const auto& [method_name, tolerance_um] = std::get<1>(GetParam());
    System system(twin.model(), make_parts(twin.values()), 1, Need::triangles | Need::volumes);
    State state = state_at(twin.model(), twin.vectors("start/x"));
    MethodParameters parameters;
    parameters.dt_s = 1e-3;
    parameters.tolerance_um = tolerance_um;
    parameters.linear_tolerance = 1e-8;
    const auto method = find_method(method_name)->make(parameters);
    ASSERT_TRUE(advance_until(*method, system, state, twin.attribute("end", "time_s")).accepted);
    ASSERT_FALSE(system.evaluate(state.x_um, state.volume_integral_s, 0.0));

    expect_same_measures(measures_of(system), twin.measures("end"), k_tolerance);
    const std::vector<Vec3> start = twin.vectors("start/x");
    std::vector<Vec3> theirs = twin.vectors("end/x"), ours = state.x_um;
    for (std::size_t i = 0; i < start.size(); ++i) theirs[i] -= start[i], ours[i] -= start[i];
    EXPECT_LE(relative_difference(ours, theirs), k_tolerance);
}

// Explicit and implicit, at tolerances with errors below half of k_tolerance.
INSTANTIATE_TEST_SUITE_P(
    Methods, TwinMotion,
    testing::Combine(testing::Values("doublet", "thirteen", "fine_doublet"),
                     testing::Values(std::pair{"rkc", 3e-6}, std::pair{"rosenbrock_w", 3e-5})),
    [](const auto& run) { return std::get<0>(run.param) + "_" + std::get<1>(run.param).first; });

TEST(TwinMotions, AreExactEnoughToJudgeTheEngine) {
    // What halving the number of the twin's steps changes is more than its error.
    for (const char* name : {"doublet", "thirteen", "fine_doublet"}) {
        const TwinProblem twin{name};
        EXPECT_LE(twin.attribute("end", "area_change_by_halving"), k_tolerance) << name;
        EXPECT_LE(twin.attribute("end", "sigma_h_change_by_halving"), k_tolerance) << name;
    }
}

}  // namespace
}  // namespace spheroscope::test
