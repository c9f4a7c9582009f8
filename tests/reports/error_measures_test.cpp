#include "engine/reports/error_measures.hpp"
#include "engine/reports/mesh_ladder.hpp"
#include "engine/reports/report_table.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>

namespace spheroscope::reports {
namespace {

std::vector<Vec3> some_points() {
    std::vector<Vec3> points;
    for (int i = 0; i < 20; ++i)
        points.emplace_back(std::sin(1.3 * i), std::cos(2.1 * i), 0.1 * i * std::sin(0.7 * i));
    return points;
}

const ErrorMeasure& measure(std::string_view name) {
    for (const ErrorMeasure& row : all_error_measures())
        if (row.name == name) return row;
    throw std::out_of_range(std::string(name));
}

TEST(ShapeError, IsBlindToARigidMotionAndSeesADeformation) {
    const std::vector<Vec3> a = some_points();
    std::vector<Vec3> moved = a;
    const Mat3 turn = Eigen::AngleAxisd(2.5, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    for (Vec3& x : moved) x = turn * x + Vec3(5, -3, 1);
    EXPECT_LT(rms_distance_of_shapes_um(a, moved), 1e-14 * 10);
    for (Vec3& x : moved) x *= 1.1;
    EXPECT_GT(rms_distance_of_shapes_um(a, moved), 0.05);
}

TEST(ShapeError, DoesNotTakeAMirrorImageForARigidMotion) {
    const std::vector<Vec3> a = some_points();
    std::vector<Vec3> mirrored = a;
    for (Vec3& x : mirrored) x.z() = -x.z();
    EXPECT_GT(rms_distance_of_shapes_um(a, mirrored), 0.1);
}

TEST(PositionError, IsTheRmsOverNodesAndTimesInUnitsOfTheScale) {
    MeasuredRun run, reference;
    const std::vector<Vec3> x = some_points();
    reference.samples = {{1.0, x}, {2.0, x}};
    run.samples = reference.samples;
    for (Vec3& node : run.samples[1].x_um) node += Vec3(0.0, 0.6, 0.0);
    const ErrorScales scales{.length_um = 0.3};
    // half of the samples are 0.6 off: 0.6 / sqrt(2) / 0.3
    EXPECT_NEAR(measure("positions").compute(run, reference, scales), std::sqrt(2.0), 1e-14);
}

TEST(PairForceError, CountsAPairThatTouchesInOneRunOnly) {
    MeasuredRun run, reference;
    reference.end.links = {{0, 1, 3.0F, 1.0F}, {0, 2, 4.0F, 1.0F}};
    run.end.links = {{0, 1, 3.0F, 1.0F}};
    EXPECT_NEAR(measure("pair_force").compute(run, reference, {}), 4.0 / 5.0, 1e-14);
}

TEST(RelativeErrors, AreUndefinedWhereTheReferenceIsZero) {
    MeasuredRun run, reference;
    run.end.sigma_h_kPa = {1e-9F, -1e-9F};
    reference.end.sigma_h_kPa = {2e-9F, -1e-9F};
    const ErrorScales scales{.length_um = 0.3, .pressure_kPa = 0.1};
    EXPECT_TRUE(std::isnan(measure("sigma_h").compute(run, reference, scales)));
    reference.end.sigma_h_kPa = {0.02F, -0.01F};
    EXPECT_NEAR(measure("sigma_h").compute(run, reference, scales), 1.0, 1e-6);
}

TEST(Extrapolation, FindsOrderAndLimitOfAPowerOfTheEdgeLength) {
    std::vector<double> values;
    for (int level = 0; level < 4; ++level)
        values.push_back(7.0 + 3.0 * std::pow(0.5, 1.7 * level));
    const Extrapolation result = extrapolate(values);
    EXPECT_TRUE(result.is_resolved);
    EXPECT_NEAR(result.order, 1.7, 1e-12);
    EXPECT_NEAR(result.limit, 7.0, 1e-12);
}

TEST(Extrapolation, IsRefusedWhereDifferencesDoNotShrinkOrChangeTheirSign) {
    EXPECT_FALSE(extrapolate(std::vector<double>{1.0, 2.0, 3.5}).is_resolved);
    EXPECT_FALSE(extrapolate(std::vector<double>{1.0, 2.0, 1.5}).is_resolved);
    EXPECT_FALSE(extrapolate(std::vector<double>{1.0, 2.0}).is_resolved);
    EXPECT_TRUE(std::isnan(extrapolate(std::vector<double>{1.0, 2.0, 3.5}).limit));
}

TEST(ReportTable, AlignsForPeopleAndKeepsEveryDigitForPrograms) {
    ReportTable table;
    table.columns = {{"name"}, {"value"}, {"more", false}};
    table.rows = {{std::string("a, \"b\""), 1.0 / 3.0, std::int64_t{7}},
                  {std::string("c"), Missing{"failed"}, true}};
    EXPECT_EQ(table.aligned_text(), "name     value\n"
                                    "a, \"b\"  0.3333\n"
                                    "c       failed\n");
    EXPECT_EQ(table.csv_text({"why"}), "# why\n"
                                       "name,value,more\n"
                                       "\"a, \"\"b\"\"\",0.3333333333333333,7\n"
                                       "c,failed,yes\n");
}

}  // namespace
}  // namespace spheroscope::reports
