#include "engine/statistics/radial_profile.hpp"
#include "tests/viewer/two_cells.hpp"
#include "viewer/model/series.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

namespace spheroscope::viewer {
namespace {

TEST(Health, MarksTheFramesThatAreBeyondALimit) {
    std::vector<FrameSummary> run(4);
    for (int i = 0; i < 4; ++i) {
        run[static_cast<std::size_t>(i)].frame = i;
        run[static_cast<std::size_t>(i)].totals.smallest_triangle = 0.5;
    }
    run[2].totals.smallest_triangle = 0.02;
    run[3].totals.smallest_triangle = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(bad_frames(row_of(Series::smallest_triangle), run), std::vector<int>{2});
    EXPECT_TRUE(bad_frames(row_of(Series::coordination), run).empty());  // has no limit
}

TEST(Health, AWallThatPressesIsNoLackOfBalance) {
    std::vector<FrameSummary> run(3);
    for (int i = 0; i < 3; ++i) {
        run[static_cast<std::size_t>(i)].frame = i;
        run[static_cast<std::size_t>(i)].diagnostics.force_balance_nN = 5.0;
    }
    run[0].diagnostics.wall_radius_um = 20.0;
    run[1].diagnostics.force_balance_nN = 1e-9;
    EXPECT_EQ(bad_frames(row_of(Series::force_balance), run), std::vector<int>{2});
}

TEST(RadialStress, OfEqualCellsIsTheirValueEverywhere) {
    const auto snapshot = two_cells();
    snapshot->fields[0] = {-0.02F, -0.02F};
    const Curve curve = radial_stress(*snapshot);
    ASSERT_GT(curve.x.size(), 15U);
    EXPECT_LT(curve.x.back(), 1.0F);
    for (const float value : curve.y) EXPECT_NEAR(value, -20.0F, 1e-3F);
}

TEST(RadialStress, IsTheProfileOfFiguresAsFarAsTheSphereOfVolume) {
    const auto snapshot = two_cells();
    // The same cells as figures measure them.
    statistics::Aggregate aggregate;
    aggregate.topology = snapshot->header->topology;
    for (std::size_t i = 0; i < snapshot->x_um.size(); i += 3)
        aggregate.x_um.emplace_back(double{snapshot->x_um[i]}, double{snapshot->x_um[i + 1]},
                                    double{snapshot->x_um[i + 2]});
    aggregate.centre_um = {Vec3(-8.0, 0.0, 0.0), Vec3(8.0, 0.0, 0.0)};
    aggregate.radius_um = {8.0, 8.0};
    for (const float volume : snapshot->volume_um3) aggregate.volume_um3.push_back(double{volume});
    aggregate.sigma_h_kPa = {-0.02, 0.03};
    statistics::finish_aggregate(aggregate);
    const std::vector<std::vector<statistics::ProbeSample>> run{statistics::sample_cells(
        aggregate, statistics::random_probes(aggregate, snapshot->header->seed),
        aggregate.sigma_h_kPa, statistics::Interpolation::nearest_cell)};
    const std::vector<statistics::ProfilePoint> profile = statistics::pooled_profile(run);
    const Curve curve = radial_stress(*snapshot);
    ASSERT_GT(profile.size(), curve.x.size());  // cells reach farther than the sphere
    for (std::size_t k = 0; k < curve.x.size(); ++k) {
        EXPECT_FLOAT_EQ(curve.x[k], static_cast<float>(profile[k].r));
        EXPECT_NEAR(curve.y[k], 1e3 * profile[k].mean, 1e-4);
    }
}

TEST(RadialStress, NeedsMechanicsAndContacts) {
    const auto snapshot = two_cells();
    snapshot->stage_name = "anneal";
    EXPECT_TRUE(radial_stress(*snapshot).x.empty());
    snapshot->stage_name = "relax";
    snapshot->links.clear();
    EXPECT_TRUE(radial_stress(*snapshot).x.empty());
}

TEST(ForceDistribution, IsADensityOfTheForcesOfAllContacts) {
    const auto snapshot = two_cells();
    snapshot->links.clear();
    for (int k = 0; k < 200; ++k)
        snapshot->links.push_back({0, 1, -std::log((static_cast<float>(k) + 0.5F) / 200.0F), 1.0F});
    for (ContactLink& link : snapshot->links)
        if (link.force_nN < 0.1F) link.force_nN *= -1.0F;  // a pull counts like a push
    const Curve curve = force_distribution(*snapshot);
    ASSERT_GT(curve.x.size(), 5U);
    const float width = curve.x[1] - curve.x[0];
    EXPECT_NEAR(std::accumulate(curve.y.begin(), curve.y.end(), 0.0F) * width, 1.0F, 1e-4F);
    // exponential: the density falls by the factor exp(-width) from bin to bin
    EXPECT_NEAR(curve.y[1] / curve.y[0], std::exp(-width), 0.1F);
}

TEST(ForceDistribution, OfHardlyAnyForceIsNothing) {
    EXPECT_TRUE(force_distribution(*two_cells()).x.empty());
}

}  // namespace
}  // namespace spheroscope::viewer
