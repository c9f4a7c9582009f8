#include "engine/cli/precision_text.hpp"

#include <fmt/format.h>
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

TEST(MeshNotes, GiveTheReasonsOfRunsThatFailedAndSayWhatHasNoLimit) {
    reports::MeshLadder ladder = ladder_of_area();
    ladder.finer = ladder.own;
    EXPECT_EQ(notes_of(ladder, 162).find("finest level"), std::string::npos);
    const auto failed = [](int nodes, const std::string& why) {
        reports::MeshLevel level{nodes, true, {}};
        level.run.verdict = RunVerdict::unstable;
        level.run.message = why;
        return level;
    };
    ladder.own_run = failed(162, "own is too long");
    ladder.finer_run = failed(162, "finer is too short");
    ladder.levels[2] = failed(642, "fine mesh is too fine");
    ladder.results[0].mesh_error_is_rough = true;
    const std::string notes = notes_of(ladder, 162);
    for (const char* text : {"162 nodes, dt = 10 ms: failed own is too long\n",
                             "162 nodes, dt = 10 ms: failed finer is too short\n",
                             "642 nodes, dt = 10 ms: failed fine mesh is too fine\n",
                             "against the finest level where no limit can be extrapolated"})
        EXPECT_NE(notes.find(text), std::string::npos) << notes;
}

TEST(PrecisionPlot, ShowsRunsThatFailedAsCrossesAtTheUpperEdgeAndNamesThem) {
    reports::Precision precision;
    const auto add = [&](double dt_s, RunVerdict verdict, double error) {
        reports::PrecisionRow row;
        row.setting.method = &all_methods().front();
        row.setting.dt_s = dt_s;
        row.was_run = true;
        row.run.verdict = verdict;
        row.run.wall_s = 0.5;
        if (verdict == RunVerdict::finished)
            row.errors.assign(reports::all_error_measures().size(), error);
        precision.rows.push_back(row);
    };
    add(0.04, RunVerdict::unstable, 0.0);
    add(0.02, RunVerdict::unstable, 0.0);
    add(0.01, RunVerdict::finished, 0.3);
    precision.reference_errors.assign(reports::all_error_measures().size(), 1e-6);
    const reports::Plot plot = plot_of(precision, "title");
    ASSERT_FALSE(plot.panels.empty());
    for (const reports::Plot::Panel& panel : plot.panels) {
        ASSERT_EQ(panel.series.size(), 2U);
        EXPECT_EQ(panel.series[0].y, (std::vector<double>{0.3}));
        EXPECT_FALSE(panel.series[0].is_crossed_out);
        const reports::Plot::Series& crosses = panel.series[1];
        EXPECT_TRUE(crosses.is_crossed_out);
        EXPECT_EQ(crosses.colour_of, panel.series[0].name);
        ASSERT_EQ(crosses.y.size(), 2U);
        EXPECT_GT(crosses.y[0], 0.3);
    }
    EXPECT_EQ(plot.caption, (std::vector<std::string>{
                                fmt::format("crosses at the upper edge failed: {}, dt = 40 ms, dt "
                                            "= 20 ms",
                                            all_methods().front().name)}));
}

}  // namespace
}  // namespace spheroscope::cli
