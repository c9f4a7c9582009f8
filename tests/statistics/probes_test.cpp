#include "engine/statistics/probes.hpp"
#include "tests/statistics/made_up_aggregate.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace spheroscope::statistics {
namespace {

TEST(Probes, AreUniformInTheBallAroundTheAggregate) {
    const Aggregate cell = test::round_cells({Vec3(5, 6, 7)}, 9.0, 42);
    const Probes probes = random_probes(cell, 1);
    const auto n = static_cast<double>(probes.at_um.size());
    EXPECT_NEAR(n, 17280.0, 0.5) << "10 000 inside R_th";
    Vec3 mean = Vec3::Zero();
    int inner = 0, within = 0;
    for (const Vec3& at : probes.at_um) {
        const double r = (at - cell.middle_um).norm() / cell.R_th_um;
        EXPECT_LE(r, k_probe_reach);
        inner += r < 0.5 ? 1 : 0;
        within += r < 1.0 ? 1 : 0;
        mean += (at - cell.middle_um) / n;
    }
    EXPECT_NEAR(within, 10000, 3 * std::sqrt(10000 * (1 - 1 / 1.728)));
    EXPECT_NEAR(inner, 1250, 3 * std::sqrt(1250.0));
    EXPECT_LT(mean.norm(), 3 * 9.0 / std::sqrt(n));
}

TEST(Probes, OfTwoSeedsAreOthers) {
    const Aggregate cell = test::round_cells({Vec3::Zero()}, 9.0, 42);
    EXPECT_NE(random_probes(cell, 1, 10).at_um, random_probes(cell, 2, 10).at_um);
    EXPECT_EQ(random_probes(cell, 1, 10).at_um, random_probes(cell, 1, 10).at_um);
}

TEST(CellsAround, FindsTheCellOfAPointAlsoOnTheAxesOfTheMesh) {
    const Aggregate cells = test::round_cells({Vec3::Zero(), Vec3(30, 0, 0)}, 9.0);
    std::vector<Vec3> points{Vec3::Zero(), Vec3(30, 0, 0), Vec3(15, 0, 0)};
    std::vector<int> wanted{0, 1, -1};
    for (const Vec3& axis : std::vector<Vec3>{Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()})
        for (const double sign : {1.0, -1.0}) {
            points.emplace_back(sign * 8.5 * axis);  // facets are at most 0.3 um below the sphere
            wanted.push_back(0);
            points.emplace_back(sign * 9.3 * axis);
            wanted.push_back(-1);
        }
    for (const Vec3& node : cells.topology->unit_shape) {
        points.emplace_back(8.8 * node);
        wanted.push_back(0);
        points.emplace_back(9.01 * node);
        wanted.push_back(-1);
    }
    EXPECT_EQ(cells_around(cells, points), wanted);
}

TEST(ProbeValues, AreThoseOfTheNearestCellOrAMeanWithInverseSquares) {
    Aggregate cells = test::round_cells({Vec3::Zero(), Vec3(20, 0, 0)}, 9.0);
    const std::vector<double> values{1.0, 4.0};
    const Probes probes{{Vec3(0, 0, 0), Vec3(5, 0, 0), Vec3(18, 0, 0)}, {0, 0, 1}};
    const auto nearest = sample_cells(cells, probes, values, Interpolation::nearest_cell);
    const auto smooth = sample_cells(cells, probes, values, Interpolation::inverse_distance);
    ASSERT_EQ(nearest.size(), 3U);
    EXPECT_EQ(nearest[1].value, 1.0);
    EXPECT_EQ(nearest[2].value, 4.0);
    EXPECT_EQ(smooth[0].value, 1.0) << "at a centre it is that cell's";
    EXPECT_NEAR(smooth[1].value, (1.0 / 25 + 4.0 / 225) / (1.0 / 25 + 1.0 / 225), 1e-12);
    EXPECT_NEAR(nearest[1].r, 5.0 / cells.R_th_um, 1e-12) << "the middle is at x = 10";
}

TEST(ProbeValues, OutsideTheSphereOfVolumeCountInsideCellsOnly) {
    const Aggregate cells = test::round_cells({Vec3::Zero(), Vec3(20, 0, 0)}, 9.0);
    const Probes probes{{Vec3(-4, 0, 0), Vec3(10, 13, 0)}, {0, -1}};
    const auto samples =
        sample_cells(cells, probes, std::vector{1.0, 4.0}, Interpolation::nearest_cell);
    ASSERT_EQ(samples.size(), 1U);
    EXPECT_GT(samples[0].r, 1.0);
}

}  // namespace
}  // namespace spheroscope::statistics
