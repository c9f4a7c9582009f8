#include "tests/claims/doublet_shape.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace spheroscope::test {
namespace {

/// Points of a sphere about `centre_um`, evenly spread (a Fibonacci spiral), seen from +z first.
std::vector<Vec3> points_on_sphere(const Vec3& centre_um, double radius_um, int n) {
    std::vector<Vec3> points;
    for (int i = 0; i < n; ++i) {
        const double z = 1.0 - (2.0 * i + 1.0) / n;
        const double angle = std::numbers::pi * (3.0 - std::sqrt(5.0)) * i;
        const double r = std::sqrt(1.0 - z * z);
        points.push_back(centre_um + radius_um * Vec3(r * std::cos(angle), r * std::sin(angle), z));
    }
    return points;
}

TEST(SphereFit, AThirdOfASphereFarFromTheOriginGivesItsCentreAndRadius) {
    const Vec3 centre(1000.0, -2000.0, 3000.0);
    const std::vector<Vec3> points = points_on_sphere(centre, 9.0, 300);
    const Sphere sphere = fit_sphere(std::span(points).first(100));
    // Coordinates of 3000 um have their last digit at 5e-13 um.
    EXPECT_NEAR((sphere.centre_um - centre).norm(), 0.0, 1e-10);
    EXPECT_NEAR(sphere.radius_um, 9.0, 1e-10);
}

/// Two spheres, each cut by the plane half way between them and flattened there.
Snapshot two_caps(double radius_um, double half_distance_um, const Vec3& axis, int n) {
    Snapshot snapshot;
    auto header = std::make_shared<RunHeader>();
    auto topology = std::make_shared<MeshTopology>();
    topology->unit_shape.resize(static_cast<std::size_t>(n));
    header->topology = topology;
    header->n_cells = 2;
    snapshot.header = header;
    for (const double side : {-1.0, 1.0})
        for (Vec3 p : points_on_sphere(side * half_distance_um * axis, radius_um, n)) {
            const double depth_um = -side * p.dot(axis);
            if (depth_um > 0.0) p += side * depth_um * axis;
            for (int k = 0; k < 3; ++k) snapshot.x_um.push_back(static_cast<float>(p[k]));
        }
    snapshot.links.push_back({0, 1, 0.0F, 123.0F});
    return snapshot;
}

TEST(DoubletShape, TwoCapsOnADiscGiveTheirAngleAndTheDiscsArea) {
    const double radius = 9.0;
    for (const double cos_theta : {0.5, 0.75, 0.9}) {
        SCOPED_TRACE(cos_theta);
        const Vec3 axis = Vec3(1.0, 2.0, -2.0) / 3.0;
        const DoubletShape shape = doublet_shape(two_caps(radius, cos_theta * radius, axis, 642));
        // Snapshots are float32: 1e-6 of 9 um. The mid-plane is known as well as the spiral is
        // even.
        EXPECT_NEAR(shape.cos_theta, cos_theta, 2e-4);
        EXPECT_NEAR(shape.cap_radius_um, radius, 1e-5);
        const double disc = std::numbers::pi * radius * radius * (1.0 - cos_theta * cos_theta);
        EXPECT_NEAR(shape.disc_area_um2, disc, 1e-3 * disc);
        EXPECT_EQ(shape.clip_area_um2, 123.0);
    }
}

}  // namespace
}  // namespace spheroscope::test
