#include "engine/reports/stability.hpp"
#include "tests/reports/stretched_cell.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace spheroscope::reports {
namespace {

const std::string k_scene = stretched_cell_text("2.5 s") + R"([expect]
n_flipped_triangles = { max = 0 }
volume_error = { max = 0.1 }
)";

TEST(Stability, ATriangleThatHasFlippedAndComeBackIsNotForgotten) {
    const scene::Scene scene = scene::parse_scene(k_scene, "stretched.toml");
    MeasuredRun run;
    run.end.totals.n_flipped_triangles = 0;
    for (const Expectation& measure : check_expectations(scene, run)) EXPECT_TRUE(measure.met);
    run.most_flipped_triangles = 3;
    const auto measures = check_expectations(scene, run);
    ASSERT_EQ(measures.size(), 2U);
    EXPECT_EQ(measures[0].measure, "n_flipped_triangles");
    EXPECT_EQ(measures[0].value, 3.0);
    EXPECT_FALSE(measures[0].met);
    EXPECT_TRUE(measures[1].met) << "other measures are those of the end";
}

TEST(Stability, LooksAfterEveryStepWithoutChangingIt) {
    const std::string text = k_scene + "[stability.all]\noutcome = \"ends\"\n";
    const scene::Scene scene = scene::parse_scene(text, "stretched.toml");
    const std::string file = testing::TempDir() + "/cell_of_stability.toml";
    std::FILE* out = std::fopen(file.c_str(), "w");
    ASSERT_NE(out, nullptr);
    std::fputs(text.c_str(), out);
    std::fclose(out);
    for (const StabilityRow& row : check_stability({file}, {}, {})) {
        EXPECT_TRUE(row.met()) << row.run.message;
        if (!row.method->moves_in_time()) continue;
        scene::Scene own = with_report_fields(scene);
        own.method.name = row.method->name;
        EXPECT_EQ(row.run.state_hash, measure_run(own, {}).state_hash) << row.method->name;
    }
    std::remove(file.c_str());
}

TEST(FlippedTriangles, AreThoseThatTheTotalsCount) {
    const auto mesh = make_icosphere(42);
    std::vector<Vec3> x_um = mesh->unit_shape;
    x_um.insert(x_um.end(), mesh->unit_shape.begin(), mesh->unit_shape.end());  // two cells
    EXPECT_EQ(count_flipped_triangles(*mesh, x_um), 0);
    // A node that has gone through the centre takes its triangles with it.
    x_um[5] *= -0.5;
    const int degree = mesh->neighbour_begin[6] - mesh->neighbour_begin[5];
    EXPECT_EQ(count_flipped_triangles(*mesh, x_um), degree);
    for (Vec3& x : x_um) x += Vec3(1e3, 0.0, 0.0);
    EXPECT_EQ(count_flipped_triangles(*mesh, x_um), degree) << "wherever the cells are";
}

TEST(FlippedTriangles, AreSeenBetweenOutputsWithEveryMethod) {
    scene::Scene scene = with_report_fields(scene::parse_scene(k_scene, "stretched.toml"));
    // A corner far beyond its neighbours, which it folds over.
    scene.start->sliver_height_um = 14.0;
    for (const MethodRow& method : all_methods()) {
        scene.method.name = method.name;
        if (!method.moves_in_time()) scene.cytosol->controller = scene::VolumeController::exact;
        // stopped before the end, which is the only output
        MeasuredRunOptions options{.max_steps = 2};
        EXPECT_EQ(measure_run(scene, options).most_flipped_triangles, 0) << method.name;
        options.watch_flips = true;
        EXPECT_GT(measure_run(scene, options).most_flipped_triangles, 0) << method.name;
    }
}

}  // namespace
}  // namespace spheroscope::reports
