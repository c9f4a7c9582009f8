#include "engine/statistics/cell_stress.hpp"
#include "tests/statistics/made_up_aggregate.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace spheroscope::statistics {
namespace {

TEST(WeightedQuantile, WithEqualWeightsIsTheUsualOne) {
    std::vector<double> values;
    for (int i = 100; i >= 0; --i) values.push_back(i);
    const std::vector<double> weights(101, 0.3);
    EXPECT_NEAR(weighted_quantile(values, weights, 0.05), 5.0, 1e-12);
    EXPECT_NEAR(weighted_quantile(values, weights, 0.953), 95.3, 1e-12);
    EXPECT_EQ(weighted_quantile(values, weights, 0.0), 0.0);
    EXPECT_EQ(weighted_quantile(values, weights, 1.0), 100.0);
}

TEST(WeightedQuantile, GivesHeavyValuesTheirShare) {
    const std::array<double, 3> values{0, 1, 2}, weights{1, 2, 1};
    EXPECT_NEAR(weighted_quantile(values, weights, 0.25), 0.5, 1e-12);
    EXPECT_NEAR(weighted_quantile(values, weights, 0.5), 1.0, 1e-12);
    EXPECT_EQ(weighted_quantile(std::array{7.0}, std::array{2.0}, 0.05), 7.0);
}

TEST(CellStress, AreMeansOverTouchingTrianglesWithAndWithoutTheirAreas) {
    Aggregate cells = test::round_cells({Vec3::Zero(), Vec3(30, 0, 0)}, 9.0, 42);
    // Two triangles of the first cell touch.
    cells.triangle_area_um2[3] = 1.0;
    cells.triangle_area_um2[8] = 3.0;
    cells.sigma_nn_kPa[3] = -0.4;
    cells.sigma_nn_kPa[8] = 0.2;
    cells.shear_kPa[3] = 0.5;
    cells.shear_kPa[8] = 0.1;
    cells.anisotropic_max_kPa[0] = 0.54;
    cells.anisotropic_mean_kPa[0] = 0.3;
    const CellStress equal = stress_of_cells(cells, Weighting::equal)[0];
    EXPECT_NEAR(equal.mean_normal, -0.1, 1e-12);
    EXPECT_NEAR(equal.mean_shear, 0.3, 1e-12);
    EXPECT_EQ(equal.anisotropic_max, 0.54) << "the measure's own";
    EXPECT_EQ(equal.anisotropic_mean, 0.3);
    const CellStress area = stress_of_cells(cells, Weighting::area)[0];
    EXPECT_NEAR(area.mean_normal, 0.05, 1e-12);
    EXPECT_NEAR(area.mean_shear, 0.2, 1e-12);
    EXPECT_NEAR(area.anisotropic_max, 0.9 * 0.6, 1e-12);
    EXPECT_NEAR(area.anisotropic_mean, 0.6 * std::sqrt(0.25 * 0.75), 1e-12);
    for (const CellStressRow& row : all_cell_stresses())
        EXPECT_TRUE(std::isnan(stress_of_cells(cells, Weighting::area)[1].*row.member))
            << "a cell that touches nothing: " << row.quantity;
}

}  // namespace
}  // namespace spheroscope::statistics
