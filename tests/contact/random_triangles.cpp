#include "tests/contact/random_triangles.hpp"

#include <cmath>
#include <numbers>

namespace spheroscope::test {
namespace {

Mat3 turn_about(const Vec3& axis, double angle_rad) {
    return Eigen::AngleAxisd(angle_rad, axis.normalized()).toRotationMatrix();
}

}  // namespace

TriangleGeometry triangle_of(const std::array<Vec3, 3>& c) {
    return {c, (c[1] - c[0]).cross(c[2] - c[0]).normalized()};
}

std::array<Vec3, 3> flat_triangle(const Random& random, std::uint64_t index) {
    std::array<Vec3, 3> corner;
    for (std::uint32_t i = 0; i < 3; ++i) {
        // Corners near those of an equilateral triangle: no slivers, always the same winding.
        const double angle =
            2.0 * std::numbers::pi * (i + 0.35 * random.uniform(index, 50 + i)) / 3.0;
        const double r_um = 0.6 + 0.6 * random.uniform(index, 60 + i);
        corner[i] = Vec3(r_um * std::cos(angle), r_um * std::sin(angle), 0.0);
    }
    return corner;
}

std::array<Vec3, 3> turned_over(const std::array<Vec3, 3>& c) { return {c[0], c[2], c[1]}; }

std::array<Vec3, 3> moved(std::array<Vec3, 3> corner_um, const Mat3& turn, const Vec3& shift_um) {
    for (Vec3& corner : corner_um) corner = turn * corner + shift_um;
    return corner_um;
}

TrianglePair random_pair(const Random& random, std::uint64_t index, Facing facing, double h0_um) {
    const auto u = [&](std::uint32_t component) { return random.uniform(index, component); };
    // Seen along +z: A below with its face up would push A down; so A lies above and looks down.
    TrianglePair pair;
    pair.a = turned_over(flat_triangle(random, 2 * index));
    pair.b = flat_triangle(random, 2 * index + 1);
    const double gap_um = 2.2 * h0_um * u(0) - 0.1 * h0_um;
    const Vec3 slide_um(u(1) - 0.5, u(2) - 0.5, 0.0);
    const Mat3 spin = turn_about(Vec3::UnitZ(), 2.0 * std::numbers::pi * u(3));
    const double azimuth = 2.0 * std::numbers::pi * u(4);
    const Vec3 hinge(std::cos(azimuth), std::sin(azimuth), 0.0);
    switch (facing) {
    case Facing::tilted: {
        const double half_wedge = u(5) * 5.0 * std::numbers::pi / 18.0;
        pair.a = moved(pair.a, turn_about(hinge, half_wedge), Vec3(0.0, 0.0, gap_um));
        pair.b = moved(pair.b, turn_about(hinge, -half_wedge) * spin, slide_um);
        break;
    }
    case Facing::parallel:
        pair.a = moved(pair.a, Mat3::Identity(), Vec3(0.0, 0.0, gap_um));
        pair.b = moved(pair.b, spin, slide_um);
        return pair;  // a common turn would round the normals apart
    case Facing::nearly_parallel:
        pair.a = moved(pair.a, turn_about(hinge, 1e-12), Vec3(0.0, 0.0, gap_um));
        pair.b = moved(pair.b, spin, slide_um);
        break;
    case Facing::shared_edge: {
        // B is A seen from below, with one corner elsewhere: two corners project onto A's.
        pair.b = turned_over(pair.a);
        pair.b[0] += Vec3(0.6 * u(6), 0.6 * u(7) - 0.3, 0.0);
        pair.a = moved(pair.a, Mat3::Identity(), Vec3(0.0, 0.0, gap_um));
        break;
    }
    }
    const Mat3 together =
        turn_about(Vec3(u(8) - 0.5, u(9) - 0.5, u(10) - 0.5), 2.0 * std::numbers::pi * u(11));
    const Vec3 shift_um(40.0 * u(12) - 20.0, 40.0 * u(13) - 20.0, 40.0 * u(14) - 20.0);
    pair.a = moved(pair.a, together, shift_um);
    pair.b = moved(pair.b, together, shift_um);
    return pair;
}

}  // namespace spheroscope::test
