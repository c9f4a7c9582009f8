#include "engine/base/error.hpp"
#include "engine/base/random.hpp"
#include "engine/stages/convex_hull.hpp"

#include <gtest/gtest.h>

#include <set>

namespace spheroscope {
namespace {

/// The corners of a cube from -1 to 1, and points inside of it.
std::vector<Vec3> cube() {
    std::vector<Vec3> points;
    for (const double x : {-1.0, 1.0})
        for (const double y : {-1.0, 1.0})
            for (const double z : {-1.0, 1.0}) points.emplace_back(x, y, z);
    const Random random(4, 9);
    for (std::uint64_t i = 0; i < 50; ++i)
        points.emplace_back(random.uniform(i, 0) - 0.5, random.uniform(i, 1) - 0.5,
                            random.uniform(i, 2) - 0.5);
    return points;
}

constexpr double k_closed = 0.0;

HullOpening opening(double radius_um) { return {Vec3::Zero(), Vec3::UnitZ(), radius_um}; }

TEST(ConvexHull, OfACubeIsItsTwelveTrianglesMovedOutward) {
    const double gap = 0.25;
    const Hull hull = make_convex_hull(cube(), gap, opening(k_closed));
    ASSERT_EQ(hull.planes.size(), 12U);
    ASSERT_EQ(hull.vertex_um.size(), 8U);
    for (const Hull::Plane& plane : hull.planes) {
        EXPECT_NEAR(plane.normal.cwiseAbs().maxCoeff(), 1.0, 1e-12);
        EXPECT_NEAR(plane.offset_um, 1.0 + gap, 1e-12);
    }
    for (const auto& corners : hull.triangle) {
        std::array<Vec3, 3> x;
        for (std::size_t k = 0; k < 3; ++k)
            x[k] = hull.vertex_um[static_cast<std::size_t>(corners[k])];
        const Vec3 normal = (x[1] - x[0]).cross(x[2] - x[0]);
        EXPECT_GT(normal.dot(x[0]), 0.0) << "counter-clockwise from outside";
    }
}

TEST(ConvexHull, ContainsEveryPointAndSaysWhichOneIsOutside) {
    std::vector<Vec3> points = cube();
    const Hull hull = make_convex_hull(points, 0.0, opening(k_closed));
    EXPECT_FALSE(find_outside(hull, points).has_value());
    points[17] = Vec3(0.2, -1.5, 0.3);
    points[23] = Vec3(0.0, 1.2, 0.0);
    const auto outside = find_outside(hull, points);
    ASSERT_TRUE(outside.has_value());
    EXPECT_EQ(outside->point, 17U);
    EXPECT_NEAR(outside->distance_um, 0.5, 1e-12);
    const Hull smaller = make_convex_hull(cube(), -0.1, opening(k_closed));
    ASSERT_TRUE(find_outside(smaller, cube()).has_value());
    EXPECT_NEAR(find_outside(smaller, cube())->distance_um, 0.1, 1e-12);
}

TEST(ConvexHull, IsOpenWhereTheOpeningIsAndThereOnly) {
    // Both triangles of the upper face have their middle 0.47 from the axis, those of the
    // sides 1.05.
    const Hull hull = make_convex_hull(cube(), 0.0, opening(0.6));
    EXPECT_EQ(hull.planes.size(), 10U);
    for (const Hull::Plane& plane : hull.planes) EXPECT_LT(plane.normal.z(), 0.5);
    std::vector<Vec3> above = {Vec3(0.0, 0.0, 5.0)};
    EXPECT_FALSE(find_outside(hull, above).has_value());
}

TEST(ConvexHull, OfPointsInAPlaneIsRefusedWithTheReason) {
    std::vector<Vec3> flat;
    for (int i = 0; i < 9; ++i) flat.emplace_back(i % 3, i / 3, 0.0);
    for (const auto& points : {flat, std::vector<Vec3>(2, Vec3::Zero())}) {
        try {
            static_cast<void>(make_convex_hull(points, 0.1, opening(k_closed)));
            ADD_FAILURE() << "no error";
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find("have no convex hull"), std::string::npos)
                << error.what();
        }
    }
}

}  // namespace
}  // namespace spheroscope
