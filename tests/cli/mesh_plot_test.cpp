#include "engine/cli/precision_text.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace spheroscope::cli {
namespace {

/// Contact areas 100 (1 + h^2) at h = 1/2, 1/4, 1/8; no other measure has a value.
reports::MeshLadder ladder_of_area() {
    reports::MeshLadder ladder;
    ladder.own.method = &all_methods().front();
    ladder.own.dt_s = 0.01;
    for (const int nodes : {42, 162, 642}) ladder.levels.push_back({nodes, true, {}});
    for (const reports::MeshMeasure& measure : reports::all_mesh_measures()) {
        reports::MeshResult result;
        const double area = measure.name == "contact_area" ? 100.0 : std::nan("");
        for (const double h : {0.5, 0.25, 0.125}) result.values.push_back(area * (1.0 + h * h));
        result.extrapolation = reports::extrapolate(result.values);
        result.time_error = 0.003;
        ladder.results.push_back(result);
    }
    return ladder;
}

TEST(MeshPlot, ShowsTheDistanceToTheLimitOverTheNodesAndTheTimeErrorBesideIt) {
    const reports::Plot plot = plot_of(ladder_of_area(), 162, "title");
    ASSERT_EQ(plot.panels.size(), 1U) << "what has no limit has no error";
    const reports::Plot::Panel& panel = plot.panels.front();
    EXPECT_EQ(panel.title, "contact_area, order 2");
    ASSERT_EQ(panel.series.size(), 2U);
    EXPECT_EQ(panel.x_axis.categories, (std::vector<std::string>{"42", "162", "642"}));
    EXPECT_EQ(panel.series[0].x, (std::vector<double>{0, 1, 2}));
    ASSERT_EQ(panel.series[0].y.size(), 3U);
    EXPECT_NEAR(panel.series[0].y[0], 0.25, 1e-9);
    EXPECT_NEAR(panel.series[0].y[2], 0.015625, 1e-9);
    EXPECT_EQ(panel.series[1].y, (std::vector<double>{0.003, 0.003, 0.003}));
    EXPECT_NE(panel.series[1].name.find("on 162 nodes"), std::string::npos);
}

TEST(MeshPlot, OfALadderWithoutALimitIsEmpty) {
    reports::MeshLadder ladder = ladder_of_area();
    for (reports::MeshResult& result : ladder.results) result.extrapolation.is_resolved = false;
    EXPECT_TRUE(plot_of(ladder, 162, "title").panels.empty());
}

}  // namespace
}  // namespace spheroscope::cli
