#include "engine/base/error.hpp"
#include "engine/statistics/setup_numbers.hpp"
#include "render/figures/figure.hpp"
#include "tests/figures/made_up_runs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <variant>

namespace spheroscope::figures {
namespace {

using statistics::group_by_setup;
using statistics::SetupStatistics;
using test::made_up_run;

std::vector<SetupStatistics> two_setups() {
    return group_by_setup({made_up_run(1, 8, 2), made_up_run(4, 8, 1), made_up_run(1, 8, 1)});
}

bool is_said(const Figure& figure, const std::string& words) {
    return std::any_of(figure.missing.begin(), figure.missing.end(), [&](const std::string& text) {
        return text.find(words) != std::string::npos;
    });
}

TEST(Setups, PoolTheSeedsAndAreNamedByWhatDiffers) {
    const auto setups = two_setups();
    ASSERT_EQ(setups.size(), 2U);
    EXPECT_EQ(setups[0].label, "γ/ω = 1, Et/ω = 8");
    EXPECT_EQ(setups[0].family, "γ/ω = 1");
    ASSERT_EQ(setups[0].runs.size(), 2U);
    EXPECT_EQ(setups[0].runs[0].seed, 1U);
    auto larger = made_up_run(1, 8, 1);
    larger.setup.n_cells = 300;
    larger.setup.scene_without_seed += "larger";
    const auto by_size = group_by_setup({made_up_run(1, 8, 1), larger});
    EXPECT_EQ(by_size[1].label, "γ/ω = 1, Et/ω = 8, N = 300");
}

TEST(Setups, WithOneSeedTwiceAreRefused) {
    EXPECT_THROW(static_cast<void>(group_by_setup({made_up_run(1, 8, 1), made_up_run(1, 8, 1)})),
                 Error);
}

TEST(RemarksOnRuns, NameCapsUnendedRunsMissingSeedsAndVersions) {
    EXPECT_TRUE(
        remarks_on_runs(group_by_setup({made_up_run(1, 8, 1), made_up_run(4, 8, 1)})).empty());
    auto capped = made_up_run(1, 8, 2);
    capped.outcome = "cap";
    auto going_on = made_up_run(1, 8, 3);
    going_on.outcome = "";
    auto other = made_up_run(4, 8, 1);
    other.version = "2";
    auto unstable = made_up_run(1, 8, 5), stopped = made_up_run(1, 8, 6);
    unstable.outcome = "unstable";
    stopped.outcome = "time limit";
    auto changed = made_up_run(8, 8, 1);
    changed.setup.changes = "12.5 cortex.tension.gamma 0.7\n";
    const auto setups =
        group_by_setup({made_up_run(1, 8, 1), capped, going_on, unstable, stopped, other, changed});
    EXPECT_EQ(
        remarks_on_runs(setups),
        (std::vector<std::string>{
            "γ/ω = 1, Et/ω = 8, seed 2: ended at the cap of time, not at rest",
            "γ/ω = 1, Et/ω = 8, seed 6: not at its end (time limit), the last frame is shown",
            "γ/ω = 1, Et/ω = 8, seed 5: not at its end (unstable), the last frame is shown",
            "γ/ω = 1, Et/ω = 8, seed 3: not at its end, the last frame is shown",
            "γ/ω = 8, Et/ω = 8: changed on the way (s, key, value in um, s, nN): "
            "12.5 cortex.tension.gamma 0.7",
            "γ/ω = 4, Et/ω = 8 has 1 seed, others have 5",
            "γ/ω = 8, Et/ω = 8 has 1 seed, others have 5", "runs of several versions: 1, 2"}));
}

TEST(RemarksOnRuns, NameTheKeysOfSetupsThatTheirLabelsDoNotTellApart) {
    const auto under_a_bead = [](const std::string& stiffness, const std::string& title) {
        auto run = made_up_run(1, 8, 1);
        run.setup.scene_alone = "[scene]\ntitle = \"" + title +
                                "\"\n\n[[stage]]\nkind = \"relax\"\n\n[[stage]]\nkind = "
                                "\"indent\"\nwall_stiffness = " +
                                stiffness + "\n";
        run.setup.scene_without_seed = run.setup.scene_alone;
        return run;
    };
    const auto setups = group_by_setup(
        {under_a_bead("1.0", "Made up"), under_a_bead("2.0", "Made up"), made_up_run(4, 8, 1)});
    EXPECT_EQ(remarks_on_runs(setups),
              (std::vector<std::string>{"γ/ω = 1, Et/ω = 8: stage[1].wall_stiffness = 1.0",
                                        "γ/ω = 1, Et/ω = 8 (2): stage[1].wall_stiffness = 2.0"}));
    const Figure figure = stress_statistics(setups);
    const auto column = std::find_if(figure.table.columns.begin(), figure.table.columns.end(),
                                     [](const auto& c) { return c.name == "setup"; });
    ASSERT_NE(column, figure.table.columns.end());
    std::set<std::string> labels;
    for (const auto& row : figure.table.rows)
        labels.insert(std::get<std::string>(
            row[static_cast<std::size_t>(column - figure.table.columns.begin())]));
    EXPECT_EQ(labels, (std::set<std::string>{"γ/ω = 1, Et/ω = 8", "γ/ω = 1, Et/ω = 8 (2)",
                                             "γ/ω = 4, Et/ω = 8"}));

    // the text alone is another one: of the motion it says the same
    auto other = under_a_bead("1.0", "Made up");
    other.setup.scene_without_seed += "\n[[picture]]\nfps = 10\n";
    EXPECT_EQ(remarks_on_runs(group_by_setup({under_a_bead("1.0", "Made up"), other})).back(),
              "γ/ω = 1, Et/ω = 8 (2): the same settings of its motion");
}

TEST(RemarksOnRuns, NameRunsThatAreCalledAtRestAndMove) {
    auto moving = made_up_run(1, 8, 2);
    moving.totals.normal_speed_rms_um_per_s = 2.5e-3;
    EXPECT_EQ(remarks_on_runs(group_by_setup({made_up_run(1, 8, 1), moving})),
              (std::vector<std::string>{
                  "γ/ω = 1, Et/ω = 8, seed 2 (rest): nodes still move with 0.0025 um/s (at "
                  "rest: less than 0.001)"}));
}

TEST(RemarksOnRuns, CountTheFramesUnderTheBeadThatHaveNoPoint) {
    auto some = made_up_run(1, 8, 1), all = made_up_run(1, 8, 2);
    some.n_undefined_loads = 1;
    all.n_undefined_loads = 3;
    all.load.clear();
    const auto setups = group_by_setup({some, all});
    EXPECT_EQ(remarks_on_runs(setups),
              (std::vector<std::string>{"γ/ω = 1, Et/ω = 8, seed 1: no points of 1 frame under the "
                                        "bead: undefined force or way",
                                        "γ/ω = 1, Et/ω = 8, seed 2: no points of 3 frames under "
                                        "the bead: undefined force or way"}));
    EXPECT_TRUE(is_said(force_displacement(setups),
                        "run_2.h5: force or way of the bead is undefined in all frames"));
}

TEST(Caption, CallsNoLastFrameAnEndThatIsNone) {
    auto stopped = made_up_run(1, 8, 2);
    stopped.outcome = "time limit";
    const auto words = [](const statistics::RunStatistics& second) {
        return stress_statistics(group_by_setup({made_up_run(1, 8, 1), second}))
            .plot.caption.front();
    };
    EXPECT_EQ(words(made_up_run(1, 8, 2)).find("2 runs of 1 setup at their end (stage: relax)"),
              0U);
    EXPECT_EQ(words(stopped).find("2 runs of 1 setup in their last frame (stage: relax)"), 0U);
}

TEST(ForceDisplacement, HasALineForEachSeedInTheOneColourOfItsSetup) {
    const auto setups =
        group_by_setup({made_up_run(1, 8, 1), made_up_run(1, 8, 2), made_up_run(4, 8, 1)});
    const Figure figure = force_displacement(setups);
    ASSERT_EQ(figure.plot.panels.size(), 1U);
    std::vector<std::string> in_legend;
    for (const reports::Plot::Series& series : figure.plot.panels[0].series)
        if (series.colour_of.empty())
            in_legend.push_back(series.name);
        else
            EXPECT_EQ(series.colour_of, in_legend.back());
    EXPECT_EQ(in_legend, (std::vector<std::string>{setups[0].label, setups[1].label}));
    EXPECT_EQ(figure.plot.panels[0].series.size(), 6U) << "bead and hull of three runs";
}

TEST(StressStatistics, HaveOneCategoryForEachRatioWhateverItsLastDigits) {
    const auto setups =
        group_by_setup({made_up_run(1, 0.75, 1), made_up_run(0.5, std::nextafter(0.75, 1.0), 1),
                        made_up_run(0.5, 1, 1), made_up_run(0.5, 1, 2)});
    const Figure figure = stress_statistics(setups);
    EXPECT_EQ(figure.plot.panels.front().x_axis.categories,
              (std::vector<std::string>{"0.75", "1"}));
    EXPECT_NE(figure.plot.caption.front().find("where larger than the mark. One seed has none."),
              std::string::npos)
        << figure.plot.caption.front();
    EXPECT_EQ(parameter_maps(setups).plot.caption.front().find("Error bars"), std::string::npos);
}

TEST(ContactNetwork, SaysInItsTitleWhetherItIsUnderTheBead) {
    auto free = made_up_run(1, 8, 1), loaded = made_up_run(4, 8, 1);
    EXPECT_EQ(contact_network(group_by_setup({loaded})).plot.title,
              "Fig. 5: contact network, under the bead");
    free.load.clear();
    EXPECT_EQ(contact_network(group_by_setup({free})).plot.title,
              "Fig. 5: contact network, without load");
    EXPECT_EQ(contact_network(group_by_setup({free, loaded})).plot.title,
              "Fig. 5: contact network");
}

TEST(EveryFigure, HasAxesWithTitlesAndEachDrawnPointInItsTable) {
    const auto setups =
        group_by_setup({made_up_run(1, 8, 1), made_up_run(1, 8, 2), made_up_run(4, 8, 1),
                        made_up_run(4, 2, 1), made_up_run(1, 2, 1)});
    for (const FigureRow& row : all_figures()) {
        const Figure figure = row.make(setups);
        ASSERT_FALSE(figure.plot.panels.empty()) << row.name;
        EXPECT_FALSE(figure.plot.caption.empty()) << row.name;
        std::size_t n_points = 0;
        for (const reports::Plot::Panel& panel : figure.plot.panels) {
            EXPECT_FALSE(panel.title.empty());
            EXPECT_FALSE(panel.y_title.empty());
            for (const reports::Plot::Series& series : panel.series) {
                EXPECT_EQ(series.x.size(), series.y.size());
                if (!series.error.empty()) {
                    EXPECT_EQ(series.error.size(), series.y.size());
                }
                if (series.colour_of.empty()) n_points += series.x.size();
                for (const double y : series.y) EXPECT_TRUE(std::isfinite(y)) << row.name;
            }
            if (panel.map)
                n_points += static_cast<std::size_t>(
                    std::count_if(panel.map->values.begin(), panel.map->values.end(),
                                  [](const auto& v) { return !std::isnan(v.value); }));
        }
        EXPECT_GE(figure.table.rows.size(), n_points) << row.name;
        for (const auto& cells : figure.table.rows)
            EXPECT_EQ(cells.size(), figure.table.columns.size());
    }
}

TEST(RadialProfiles, AreInPascalWithTheErrorOverSeeds) {
    const auto setups = two_setups();
    const Figure figure = radial_profiles(setups);
    const reports::Plot::Panel& panel = figure.plot.panels[0];
    EXPECT_EQ(panel.y_title, "σʰ (Pa)");
    const reports::Plot::Series& two_seeds = panel.series[0];
    EXPECT_NEAR(two_seeds.x[0], 0.025, 1e-12);
    EXPECT_NEAR(two_seeds.y[0], 1000.0 * (0.025 - 0.6 + 0.015), 1e-6);
    EXPECT_NEAR(two_seeds.error[0], 5.0, 1e-6) << "0.01 and 0.02 kPa: half their difference";
    EXPECT_TRUE(std::isnan(panel.series[1].error[0])) << "one seed";
}

TEST(StressProfiles, HaveTheExperimentsBands) {
    const auto setups = two_setups();
    const Figure figure = stress_profiles(setups);
    ASSERT_EQ(figure.plot.panels.size(), 4U);
    ASSERT_EQ(figure.plot.panels[2].bands.size(), 1U);
    EXPECT_EQ(figure.plot.panels[2].bands[0].low, 1500.0);
    EXPECT_EQ(figure.plot.panels[3].bands[0].high, 350.0);
}

TEST(ContactNetwork, FitsAnExponentialWithOne) {
    const auto setups = two_setups();
    const Figure figure = contact_network(setups);
    ASSERT_EQ(figure.plot.panels.size(), 4U);
    EXPECT_NEAR(figure.plot.panels[3].series[0].y[0], 1.0, 0.03);
    EXPECT_EQ(figure.plot.panels[0].series[0].y[0], 12.0);
    EXPECT_EQ(figure.plot.panels[2].series[1].colour_of, setups[0].label) << "its fit";
}

TEST(ContactNetwork, HasOneNameForEachSetupAndNoLineBetweenSetups) {
    const auto setups =
        group_by_setup({made_up_run(1, 0.125, 1), made_up_run(1, 8, 1), made_up_run(4, 8, 1)});
    const Figure figure = contact_network(setups);
    std::set<std::string> names;
    for (const reports::Plot::Panel& panel : figure.plot.panels)
        for (const reports::Plot::Series& series : panel.series)
            if (series.colour_of.empty()) names.insert(series.name);
    EXPECT_EQ(names, (std::set<std::string>{setups[0].label, setups[1].label, setups[2].label}));
    for (const std::size_t p : {0U, 3U}) {
        const reports::Plot::Panel& panel = figure.plot.panels[p];
        ASSERT_EQ(panel.series.size(), 3U) << panel.title;
        for (const reports::Plot::Series& series : panel.series) {
            EXPECT_EQ(series.line, reports::Plot::Line::none) << series.name;
            EXPECT_EQ(series.x.size(), 1U);
        }
        EXPECT_EQ(panel.series[0].x[0], 0.0) << "alone in its category";
        EXPECT_NEAR(panel.series[1].x[0], 0.95, 1e-12);
        EXPECT_NEAR(panel.series[2].x[0], 1.05, 1e-12) << "beside the other one with Et/omega = 8";
    }
    EXPECT_EQ(stress_statistics(setups).plot.panels[0].series.size(), 2U)
        << "there a line over Et/omega for each gamma/omega";
}

TEST(StressFigures, BreakTheAxisBeforeTheExperimentsMeanNormalStressAlone) {
    const auto setups = two_setups();
    for (const Figure& figure : {stress_profiles(setups), stress_statistics(setups)})
        for (std::size_t p = 0; p < figure.plot.panels.size(); ++p)
            EXPECT_EQ(figure.plot.panels[p].y_axis.breaks_before_bands, p == 0) << p;
}

TEST(ContactNetwork, SaysWhichSetupHasTooFewForces) {
    auto few = made_up_run(1, 8, 1);
    few.pairs.resize(20);
    const auto setups = group_by_setup({few});
    const Figure figure = contact_network(setups);
    EXPECT_TRUE(is_said(figure, "forces lie above the mean"));
}

TEST(ParameterMaps, ShowMissingPointsAndThoseOutsideOfTable2OnOneRange) {
    std::vector<statistics::RunStatistics> runs;
    for (const double gamma : {0.5, 1.0})
        for (const double Et : {0.125, 0.5}) runs.push_back(made_up_run(gamma, Et, 1));
    runs.push_back(made_up_run(8, 0.125, 1));  // E = 0.039 kPa
    runs.push_back(made_up_run(0.75, 0.25, 1));
    runs[0].setup.limiter_nN_per_um = 0.1;
    runs[1].totals.n_flipped_triangles = 1;
    runs[3].totals.smallest_triangle = 0.29;
    const auto setups = group_by_setup(runs);
    const Figure figure = parameter_maps(setups);
    ASSERT_EQ(figure.plot.panels.size(), 6U) << "three measures on two grids";
    const reports::Plot::Map& broad = *figure.plot.panels[0].map;
    const reports::Plot::Map& refined = *figure.plot.panels[1].map;
    EXPECT_EQ(broad.x_labels, (std::vector<std::string>{"1/8", "1/2", "2", "8", "32", "64"}));
    EXPECT_EQ(broad.low, refined.low);
    EXPECT_EQ(broad.high, refined.high);
    EXPECT_NEAR(broad.values[0].value, 0.56, 1e-12);
    EXPECT_TRUE(std::isnan(broad.values[2].value)) << "no run with Et/omega = 2";
    const auto& corner = broad.values[4 * 6];
    EXPECT_FALSE(std::isnan(corner.value));
    EXPECT_NE(corner.mark.find("†"), std::string::npos);
    EXPECT_EQ(broad.values[0].mark, "‡") << "the strain limiter is on";
    EXPECT_EQ(broad.values[1].mark, "×") << "a flipped triangle";
    EXPECT_EQ(broad.values[6].mark, "");
    EXPECT_EQ(broad.values[7].mark, "×") << "a collapsed triangle";
    EXPECT_TRUE(is_said(figure, "in 1 of 1 seed a triangle is flipped, or below 0.3"));
    EXPECT_TRUE(is_said(figure, "broad grid: 5 of 30 points have runs"));
}

TEST(ParameterMaps, DrawNoSecondGridThatShowsTheSamePoints) {
    std::vector<statistics::RunStatistics> runs;
    for (const double gamma : {0.5, 1.0, 2.0})
        for (const double Et : {0.125, 0.5}) runs.push_back(made_up_run(gamma, Et, 1));
    const Figure figure = parameter_maps(group_by_setup(runs));
    EXPECT_EQ(figure.plot.panels.size(), 3U);
    EXPECT_TRUE(is_said(figure, "broad grid: 6 of 30 points have runs"));
    EXPECT_TRUE(is_said(figure, "refined grid: 4 of 25 points have runs"));
}

TEST(ParameterMaps, LeaveOutTheBroadGridWhereTheRefinedOneHasAllOfItsPoints) {
    std::vector<statistics::RunStatistics> runs;
    for (const double gamma : {0.5, 0.75, 1.0})
        for (const double Et : {0.125, 0.25, 0.5}) runs.push_back(made_up_run(gamma, Et, 1));
    const Figure figure = parameter_maps(group_by_setup(runs));
    ASSERT_EQ(figure.plot.panels.size(), 3U);
    EXPECT_NE(figure.plot.panels[0].title.find("refined grid"), std::string::npos);
    EXPECT_TRUE(is_said(figure, "broad grid: 4 of 30 points have runs"));
}

TEST(ParameterMaps, OfRunsThatAreNoGridAreNotDrawnAndSayWhy) {
    const auto setups = two_setups();
    const Figure figure = parameter_maps(setups);
    EXPECT_TRUE(figure.plot.panels.empty());
    EXPECT_TRUE(is_said(figure, "a map wants two of each"));
}

TEST(ParameterMaps, OfRunsThatDifferInMoreSayInWhat) {
    auto other = made_up_run(2, 0.5, 1);
    other.setup.law = "variational";
    const auto setups = group_by_setup({made_up_run(1, 0.125, 1), other});
    EXPECT_TRUE(is_said(parameter_maps(setups), "variational"));
}

TEST(Numbers, HaveTheDepthsOfTheProfile) {
    const auto setups = two_setups();
    const auto numbers = statistics::numbers_of(setups[1]);
    const auto find = [&](const std::string& name) {
        for (const statistics::SetupNumber& number : numbers)
            if (number.name == name) return number.estimate.mean;
        return std::nan("");
    };
    EXPECT_NEAR(find("sigma_h_zero_depth"), 50.0 * (1.0 - 0.59), 0.01);
    EXPECT_NEAR(find("sigma_h_zero_depth_pooled"), 50.0 * (1.0 - 0.59), 0.01);
    EXPECT_NEAR(find("sigma_h_zero_depth_below_farthest_node"), 55.0 - 50.0 * 0.59, 0.01);
    EXPECT_NEAR(find("sigma_h_peak_depth_pooled"), 50.0 * (1.0 - 1.175), 0.01);
    EXPECT_NEAR(find("sigma_h_peak_depth_below_farthest_node"), 55.0 - 50.0 * 1.175, 0.01);
    EXPECT_EQ(find("extent"), 55.0);
    EXPECT_NEAR(find("void_fraction"), 0.0, 1e-12);
    EXPECT_NEAR(find("mean_normal_stress"), -100.0, 1e-9);
    EXPECT_NEAR(find("mean_normal_stress_by_area"), -200.0, 1e-9);
    EXPECT_EQ(find("coordination_Z"), 12.0);
}

TEST(Numbers, KnowThePeakOfAProfileToHalfABin) {
    const auto setups = two_setups();
    ASSERT_EQ(setups[0].runs.size(), 2U);
    for (const statistics::SetupNumber& number : statistics::numbers_of(setups[0]))
        if (number.name.starts_with("sigma_h_peak_depth_")) {
            EXPECT_NEAR(number.estimate.standard_error, 0.5 * 0.05 * 50.0, 1e-12)
                << number.name << ": no seed moves it";
        }
}

}  // namespace
}  // namespace spheroscope::figures
