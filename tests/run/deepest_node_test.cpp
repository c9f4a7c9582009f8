// The depth of nodes inside other cells is measured where [expect] asks for it, and nowhere else.
#include "engine/run/engine.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace spheroscope::test {
namespace {

Totals totals_at_the_end(const std::string& expect) {
    const scene::Scene scene = scene::parse_scene(R"([cells]
arrangement = "centres"
nodes = 42
centres = [[0, 0, -8, 9], [0, 0, 8, 9]]
[cortex.tension]
gamma = 0.5
[cortex.viscosity]
eta = 1
[cytosol]
[medium]
[contact]
repulsion_k = 2.8
[method]
dt = "1 ms"
[[stage]]
kind = "relax"
duration = "2 ms"
[measures]
fields = []
[expect]
)" + expect,
                                                  "doublet.toml");
    Engine engine(scene, {.threads = 1, .version = {}, .command_line = {}});
    EngineSinks sinks;
    sinks.frame = [](const SnapshotPtr&) { return std::optional<std::string>(); };
    return engine.run(sinks, std::atomic<bool>{false}).totals;
}

TEST(DeepestNode, IsMeasuredWhereTheSceneExpectsSomethingOfIt) {
    const Totals totals = totals_at_the_end("deepest_node = { max = 3 }\n");
    EXPECT_GT(totals.deepest_node_um, 0.5) << "spheres that overlap by 2 um";
    EXPECT_LT(totals.deepest_node_um, 2.5);
    EXPECT_TRUE(std::isnan(totals_at_the_end("volume_error = { max = 1 }\n").deepest_node_um));
}

}  // namespace
}  // namespace spheroscope::test
