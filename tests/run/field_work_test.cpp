#include "engine/run/engine.hpp"
#include "engine/scene/scene.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <string>

namespace spheroscope {
namespace {

/// A drop that is measured five times: at the start and after each of four intervals.
RunResult run_drop(const std::string& fields) {
    const std::string text = R"([scene]
title = "drop"
[cells]
arrangement = "single"
nodes = 42
radius = "9 um"
[cortex.elastic]
E = "20 kPa"
[cortex.tension]
gamma = "0.5 nN/um"
[cytosol]
controller = "proportional"
K = "5 kPa"
[medium]
eta_f = "0.05 kPa s"
[[stage]]
kind = "relax"
duration = "0.04 s"
every = "0.01 s"
[measures]
fields = )" + fields + "\n";
    Engine engine(scene::parse_scene(text, "drop.toml"), {});
    EngineSinks sinks;
    sinks.frame = [](const SnapshotPtr&) { return std::optional<std::string>(); };
    const std::atomic<bool> stop{false};
    return engine.run(sinks, stop);
}

TEST(FieldWork, AFieldThatIsNotWantedIsNeverEvaluated) {
    const RunResult result = run_drop(R"(["pressure"])");
    ASSERT_EQ(result.frames, 5);
    EXPECT_EQ(result.work.evaluations("pressure"), 5);
    EXPECT_EQ(result.work.evaluations("gamma_eff"), 0);
    EXPECT_EQ(result.work.evaluations("gamma_total"), 0);
}

TEST(FieldWork, AFieldThatIsWantedIsEvaluatedOncePerFrame) {
    const RunResult result = run_drop(R"(["pressure", "gamma_eff"])");
    EXPECT_EQ(result.work.evaluations("pressure"), 5);
    EXPECT_EQ(result.work.evaluations("gamma_eff"), 5);
    EXPECT_EQ(result.work.evaluations("gamma_total"), 0);
}

}  // namespace
}  // namespace spheroscope
