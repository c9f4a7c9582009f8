#include "engine/run/companion.hpp"
#include "engine/run/engine.hpp"
#include "engine/stages/choices.hpp"
#include "tests/scene/case_a_text.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <span>
#include <stdexcept>
#include <string>

namespace spheroscope {
namespace {

/// x' = -x from 1 by implicit Euler steps of dt_s; returns x at the end.
double decay(ApproachToRest& approach, double dt_s, int n_steps, double& speed_um_per_s) {
    double x = 1.0;
    for (int k = 0; k < n_steps; ++k) {
        const double before = x;
        x /= 1.0 + dt_s;
        speed_um_per_s = (before - x) / dt_s;
        const std::vector<Vec3> v{Vec3(-speed_um_per_s, 0.0, 0.0)};
        approach.after_step(dt_s);
        approach.after_measurement(dt_s * (k + 1), v);
    }
    return x;
}

TEST(MissingTime, OfADecayTimesItsSpeedIsWhatIsLeftOfIt) {
    ApproachToRest approach;
    double speed_um_per_s = 0.0;
    const double x = decay(approach, 0.01, 300, speed_um_per_s);
    EXPECT_NEAR(approach.missing_time_s(3.0) * speed_um_per_s, x, 0.02 * x);
}

TEST(MissingTime, IsUnknownWithoutAStepOnTheMesh) {
    ApproachToRest approach;
    EXPECT_TRUE(std::isnan(approach.missing_time_s(1.0)));
    double speed_um_per_s = 0.0;
    decay(approach, 0.01, 3, speed_um_per_s);
    EXPECT_FALSE(std::isnan(approach.missing_time_s(1.0)));
    approach.forget_step();
    EXPECT_TRUE(std::isnan(approach.missing_time_s(1.0)));
}

TEST(MissingTime, OfAMotionThatDoesNotSlowDownIsThatOfAnotherStage) {
    ApproachToRest approach;
    const std::vector<Vec3> v{Vec3(0.0, 0.25, 0.0)};
    for (int k = 1; k <= 3; ++k) {
        approach.after_step(1.0);
        approach.after_measurement(k, v);
    }
    EXPECT_EQ(approach.missing_time_s(8.0), 8.0);
}

TEST(MissingTime, OfARunIsAtMostThatOfItsLastStage) {
    const std::string two_stages = R"([cells]
arrangement = "centres"
nodes = 42
centres = [[0, 0, -8.8, 9], [0, 0, 8.8, 9]]
)" + k_case_a_cell + case_a_contact() +
                                   R"([[stage]]
kind = "relax"
duration = "0.5 s"
[[stage]]
kind = "relax"
until = "rest"
cap = "0.05 s"
every = "0.01 s"
)";
    const scene::Scene scene = scene::parse_scene(two_stages, "two_stages.toml");
    Engine engine(scene, {.threads = 1, .version = {}, .command_line = {}});
    EngineSinks sinks;
    sinks.frame = [](const SnapshotPtr&) { return std::optional<std::string>(); };
    const std::atomic<bool> stop{false};
    const RunResult result = engine.run(sinks, stop);
    ASSERT_EQ(result.outcome, "cap");
    ASSERT_NEAR(result.time_s, 0.55, 1e-9);
    const ApproachToRest& approach = engine.state().approach;
    ASSERT_GT(approach.missing_time_s(0.55), 0.1) << "the cells are far from rest";
    ASSERT_FALSE(result.errors.empty());
    for (const MeasureError& error : result.errors) {
        EXPECT_TRUE(std::isnan(error.measured())) << "one run measures no error";
        if (error.measure != "contact_area") continue;
        // It has grown from nothing in 0.55 s; in as much time as the stage's it may not double.
        EXPECT_GT(error.rest, 0.0);
        EXPECT_LT(error.rest, error.value);
    }
}

TEST(MeasureError, AddsWhatWasMeasuredSaysWhatWouldHalveTheLargestAndWhenNothingIsResolved) {
    MeasureError error{"contact_area", "um^2", 10.0};
    EXPECT_TRUE(std::isnan(error.measured()));
    EXPECT_TRUE(error.is_resolved());
    EXPECT_EQ(error.advice(), "");
    error.rest = 4.0;
    EXPECT_TRUE(std::isnan(error.measured())) << "what may come is no error";
    EXPECT_NE(error.advice().find("relaxation"), std::string::npos);
    error.time = 3.0;
    EXPECT_DOUBLE_EQ(error.measured(), 3.0);
    EXPECT_TRUE(error.is_resolved());
    error.mesh = 4.5;
    EXPECT_DOUBLE_EQ(error.measured(), std::hypot(3.0, 4.5));
    EXPECT_NE(error.advice().find("mesh"), std::string::npos);
    error.time = 20.0;
    error.halves_time = "half";
    EXPECT_FALSE(error.is_resolved());
    EXPECT_EQ(error.advice(), "time steps: half");
    error.time = 3.0;
    error.rest = 11.0;
    EXPECT_FALSE(error.is_resolved()) << "a state so far from rest says nothing about rest";
}

TEST(MeasureError, LargerThanTheStressOfTheCoreLeavesNothingOfWhatFollowsFromIt) {
    MeasureError core{"sigma_h_core", "kPa", -0.002};
    core.mesh = 0.001;
    const auto is_shown = [&](const char* name) {
        return is_resolved(*find_total(name), std::span(&core, 1));
    };
    for (const char* name : {"sigma_h_core", "eps_YL_omega", "eps_YL_W"})
        EXPECT_TRUE(is_shown(name)) << name;
    core.mesh = 0.003;
    for (const char* name : {"sigma_h_core", "eps_YL_omega", "eps_YL_W"})
        EXPECT_FALSE(is_shown(name)) << name;
    for (const char* name :
         {"sigma_h_rim", "sigma_h_mean", "sigma_h_core_by_volume", "R_th", "energy"})
        EXPECT_TRUE(is_shown(name)) << name;
}

TEST(TimeError, IsHalvedByWhatTheOrdersOfTheMethodSay) {
    const auto advice = [](const char* method, bool are_fixed) {
        return advice_on_time_steps(*find_method(method), are_fixed);
    };
    EXPECT_EQ(advice("forward_euler", true), "0.5 times method.dt halves it");
    EXPECT_EQ(advice("rosenbrock_w", true), "0.71 times method.dt halves it");
    EXPECT_EQ(advice("equilibrium", false), "");
    EXPECT_TRUE(advice("linearly_implicit", false).starts_with("0.25 times method.tolerance"));
    EXPECT_TRUE(advice("rosenbrock_w", false).starts_with("0.5 times method.tolerance"));
    EXPECT_TRUE(advice("rkc", false).starts_with("0.35 times method.tolerance"));
    EXPECT_NE(advice("linearly_implicit", false).find("late"), std::string::npos);
    EXPECT_EQ(advice("rkc", false).find("late"), std::string::npos);
}

TEST(TimeError, OfASecondRunIsRichardsons) {
    Totals own{}, finer{};
    own.contact_area_um2 = 100.0;
    finer.contact_area_um2 = 97.0;
    std::vector<MeasureError> errors = measure_errors(own, nullptr, 0.0, 0.0);
    for (const int order : {1, 2}) {
        set_time_error(errors, finer, order);
        for (const MeasureError& error : errors)
            if (error.measure == "contact_area") {
                EXPECT_NEAR(error.time, order == 1 ? 6.0 : 4.0, 1e-12);
            }
    }
}

TEST(MeshError, IsAThirdOfTheDifferenceToTheCoarserMeshOrOfAQuarterOfTheOneBefore) {
    Totals fine{}, coarse{}, coarser{};
    fine.contact_area_um2 = 100.0;
    coarse.contact_area_um2 = 90.0;
    coarser.contact_area_um2 = 50.0;  // falls by four
    fine.sigma_h_size_kPa = 2.0;
    coarse.sigma_h_size_kPa = 2.0;  // on either side of the limit
    coarser.sigma_h_size_kPa = 1.4;
    std::vector<MeasureError> errors = measure_errors(fine, nullptr, 0.0, 0.0);
    const auto error_of = [&](std::string_view name) {
        for (const MeasureError& error : errors)
            if (error.measure == name) return error.mesh;
        throw std::runtime_error("no such measure");
    };
    add_mesh_error(errors, std::span(&coarse, 1));
    EXPECT_NEAR(error_of("contact_area"), 10.0 / 3.0, 1e-12);
    EXPECT_EQ(error_of("sigma_h_size"), 0.0);
    add_mesh_error(errors, std::array{coarse, coarser});
    EXPECT_NEAR(error_of("contact_area"), 10.0 / 3.0, 1e-12);
    EXPECT_NEAR(error_of("sigma_h_size"), 0.6 / 4.0 / 3.0, 1e-12);
    EXPECT_EQ(errors.size(), estimated_measures().size());
    for (const MeasureError& error : errors) EXPECT_TRUE(std::isnan(error.time));
}

}  // namespace
}  // namespace spheroscope
