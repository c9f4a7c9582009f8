#include "engine/run/companion.hpp"
#include "engine/run/engine.hpp"
#include "engine/stages/choices.hpp"
#include "tests/scene/case_a_text.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace spheroscope {
namespace {

/// x' = -rate x from (1, 0, 0), by implicit Euler steps of dt_s; returns x at the end.
double decay(ErrorCollector& collector, double rate_per_s, double dt_s, int n_steps) {
    double x = 1.0;
    for (int k = 0; k < n_steps; ++k) {
        const double before = x;
        x /= 1.0 + rate_per_s * dt_s;
        const std::vector<Vec3> v{Vec3((x - before) / dt_s, 0.0, 0.0)};
        collector.after_step(dt_s, v);
        collector.after_measurement(dt_s * (k + 1), v);
    }
    return x;
}

/// The error by time steps of x after `decay`.
double error_um(const ErrorCollector& collector) {
    return collector.time_error_s(1) * collector.last_step_back_um()[0].norm() /
           collector.last_step_s();
}

TEST(TimeError, OfADecayIsOfTheSizeOfTheTrueOneAndHalvesWithTheStep) {
    double before_um = 0.0;
    for (const double dt_s : {0.02, 0.01, 0.005}) {
        ErrorCollector collector;
        const double x = decay(collector, 1.0, dt_s, static_cast<int>(std::lround(1.0 / dt_s)));
        const double ratio = std::abs(x - std::exp(-1.0)) / error_um(collector);
        EXPECT_GT(ratio, 0.1) << dt_s;
        EXPECT_LT(ratio, 3.0) << dt_s;
        if (before_um > 0.0) {
            EXPECT_NEAR(error_um(collector) / before_um, 0.5, 0.05);
        }
        before_um = error_um(collector);
    }
}

TEST(TimeError, VanishesAtRestAndIsUnknownWithoutStepsOrOrder) {
    ErrorCollector collector;
    EXPECT_TRUE(std::isnan(collector.time_error_s(1)));
    const double x = decay(collector, 1.0, 0.5, 100);
    EXPECT_LT(error_um(collector), 1e-12);
    EXPECT_LT(x, 1e-12);
    EXPECT_TRUE(std::isnan(collector.time_error_s(0)));
    collector.forget_velocities();
    EXPECT_TRUE(std::isnan(collector.time_error_s(1)));
}

TEST(MissingTime, OfADecayTimesItsSpeedIsWhatIsLeftOfIt) {
    ErrorCollector collector;
    const double x = decay(collector, 1.0, 0.01, 300);
    const double speed = collector.last_step_back_um()[0].x() / collector.last_step_s();
    EXPECT_NEAR(collector.missing_time_s(3.0) * speed, x, 0.02 * x);
}

TEST(MissingTime, OfAMotionThatDoesNotSlowDownIsThatOfAnotherStage) {
    ErrorCollector collector;
    const std::vector<Vec3> v{Vec3(0.0, 0.25, 0.0)};
    for (int k = 1; k <= 3; ++k) {
        collector.after_step(1.0, v);
        collector.after_measurement(k, v);
    }
    EXPECT_EQ(collector.missing_time_s(8.0), 8.0);
    EXPECT_EQ(collector.last_step_back_um()[0], Vec3(0.0, -0.25, 0.0));
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
    const ErrorCollector& seen = engine.state().errors;
    ASSERT_GT(seen.missing_time_s(0.55), 0.1) << "the cells are far from rest";
    ASSERT_FALSE(result.errors.empty());
    for (const MeasureError& error : result.errors) {
        // Both parts are a time times the rate at which the measure still changes.
        const double per_s = error.time / seen.time_error_s(chosen_method(scene).order);
        if (per_s == 0.0) continue;
        EXPECT_NEAR(error.rest / per_s, 0.05, 1e-6) << error.measure;
    }
}

TEST(MeasureError, AddsItsPartsSaysWhatWouldHalveTheLargestAndWhenNothingIsResolved) {
    MeasureError error{"contact_area", "um^2", 10.0, 3.0, 4.0};
    EXPECT_DOUBLE_EQ(error.total(), 5.0);
    EXPECT_TRUE(error.is_resolved());
    EXPECT_NE(error.advice().find("relaxation"), std::string::npos);
    error.mesh = 12.0;
    EXPECT_DOUBLE_EQ(error.total(), 13.0);
    EXPECT_FALSE(error.is_resolved());
    EXPECT_NE(error.advice().find("mesh"), std::string::npos);
    error.time = 20.0;
    error.halves_time = "half";
    EXPECT_EQ(error.advice(), "time steps: half");
    const MeasureError unknown{"energy", "fJ", 1.0};
    EXPECT_TRUE(std::isnan(unknown.total()));
    EXPECT_TRUE(unknown.is_resolved());
    EXPECT_EQ(unknown.advice(), "");
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
    std::vector<MeasureError> errors = measure_errors(own, nullptr, 0.0, 0.0, 0.0);
    for (const int order : {1, 2}) {
        set_time_error(errors, finer, order);
        for (const MeasureError& error : errors)
            if (error.measure == "contact_area") {
                EXPECT_TRUE(error.time_is_measured);
                EXPECT_NEAR(error.time, order == 1 ? 6.0 : 4.0, 1e-12);
            }
    }
}

TEST(MeshError, IsAThirdOfTheDifferenceToTheCoarserMesh) {
    Totals fine{}, coarse{};
    fine.contact_area_um2 = 100.0;
    coarse.contact_area_um2 = 90.0;
    std::vector<MeasureError> errors = measure_errors(fine, nullptr, 0.0, 0.0, 0.0);
    add_mesh_error(errors, coarse);
    for (const MeasureError& error : errors)
        if (error.measure == "contact_area") {
            EXPECT_NEAR(error.mesh, 10.0 / 3.0, 1e-12);
            EXPECT_TRUE(std::isnan(error.time));
        }
    EXPECT_EQ(errors.size(), estimated_measures().size());
}

}  // namespace
}  // namespace spheroscope
