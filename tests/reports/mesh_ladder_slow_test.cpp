// Mesh error and time error are two things: what the mesh does is the same whatever moves the
// nodes.
#include "engine/reports/mesh_ladder.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <string>

namespace spheroscope::reports {
namespace {

MeshLadder ladder_of(const std::string& method) {
    return compute_mesh_ladder(
        scene::load_scene(std::string(SPHEROSCOPE_SOURCE_DIR) + "/scenes/bench/doublet_soft.toml",
                          {{"method.name", method}}),
        642, {});
}

TEST(MeshLadder, GivesTheSameErrorOfTheMeshWithAMethodThatLagsAndOneThatDoesNot) {
    const MeshLadder lags = ladder_of("linearly_implicit"), does_not = ladder_of("rkc");
    int n_compared = 0;
    for (std::size_t m = 0; m < lags.results.size(); ++m) {
        const MeshResult &a = lags.results[m], &b = does_not.results[m];
        const std::string_view name = all_mesh_measures()[m].name;
        std::cout << fmt::format("{:<16} mesh {:.3g}, {:.3g} time {:.2g}, {:.2g}\n", name,
                                 a.mesh_error, b.mesh_error, a.time_error, b.time_error);
        if (std::isnan(a.mesh_error) && std::isnan(b.mesh_error)) continue;
        ++n_compared;
        EXPECT_NEAR(a.mesh_error / b.mesh_error, 1.0, 0.1) << name;
        if (name == "contact_area") {
            EXPECT_GT(a.time_error, 10.0 * b.time_error) << "and the lag is an error of the steps";
        }
    }
    EXPECT_GE(n_compared, 4);
}

}  // namespace
}  // namespace spheroscope::reports
