#include "engine/base/random.hpp"
#include "engine/forces/nearest_inside.hpp"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace spheroscope {
namespace {

constexpr double k_rounding_um = 1e-9;

/// Twenty planes in random directions, one unit from the origin or a little more.
struct Polyhedron {
    std::vector<Hull::Plane> planes;
    std::vector<const Hull::Plane*> pointers;

    explicit Polyhedron(std::uint64_t seed, int n_planes = 20) {
        const Random random(seed, 1);
        for (int i = 0; i < n_planes; ++i) {
            Vec3 normal;
            for (std::uint32_t k = 0; k < 3; ++k)
                normal[static_cast<Eigen::Index>(k)] =
                    random.uniform(static_cast<std::uint64_t>(i), k) - 0.5;
            planes.push_back({normal.normalized(),
                              1.0 + 0.2 * random.uniform(static_cast<std::uint64_t>(i), 3)});
        }
        for (const Hull::Plane& plane : planes) pointers.push_back(&plane);
    }
    [[nodiscard]] bool contains(const Vec3& x) const {
        return std::all_of(planes.begin(), planes.end(), [&](const Hull::Plane& plane) {
            return plane.normal.dot(x) <= plane.offset_um + k_rounding_um;
        });
    }
    /// The nearest of all points that are on one, two or three planes, and inside.
    [[nodiscard]] double least_distance_um(const Vec3& x) const {
        if (contains(x)) return 0.0;
        double least_um = std::numeric_limits<double>::infinity();
        const std::size_t n = planes.size();
        for (std::size_t a = 0; a < n; ++a)
            for (std::size_t b = a; b < n; ++b)
                for (std::size_t c = b; c < n; ++c) {
                    std::vector<std::size_t> on{a};
                    if (b > a) on.push_back(b);
                    if (c > b) on.push_back(c);
                    Eigen::MatrixXd N(on.size(), 3);
                    Eigen::VectorXd beyond(on.size());
                    for (std::size_t k = 0; k < on.size(); ++k) {
                        const auto row = static_cast<Eigen::Index>(k);
                        N.row(row) = planes[on[k]].normal.transpose();
                        beyond[row] = planes[on[k]].normal.dot(x) - planes[on[k]].offset_um;
                    }
                    const Vec3 y = x - N.transpose() * (N * N.transpose()).ldlt().solve(beyond);
                    if (contains(y)) least_um = std::min(least_um, (y - x).norm());
                }
        return least_um;
    }
};

Vec3 random_point(const Random& random, std::uint64_t i, double size_um) {
    return size_um *
           Vec3(random.uniform(i, 0) - 0.5, random.uniform(i, 1) - 0.5, random.uniform(i, 2) - 0.5);
}

TEST(NearestInside, IsTheNearestOfAllPointsOfFacesEdgesAndCorners) {
    std::array<int, 4> n_found{};
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        const Polyhedron polyhedron(seed);
        const Random random(seed, 2);
        for (std::uint64_t i = 0; i < 30; ++i) {
            const Vec3 x = random_point(random, i, 5.0);
            const NearestInside found = nearest_inside(polyhedron.pointers, x);
            EXPECT_TRUE(polyhedron.contains(found.point_um));
            EXPECT_NEAR((found.point_um - x).norm(), polyhedron.least_distance_um(x),
                        k_rounding_um);
            ++n_found[static_cast<std::size_t>(found.n_across)];
            // the way there is along the normals of the planes that it lies on
            Vec3 rest = x - found.point_um;
            for (int k = 0; k < found.n_across; ++k) {
                const Vec3& across = found.across[static_cast<std::size_t>(k)];
                EXPECT_NEAR(across.norm(), 1.0, 1e-12);
                rest -= across.dot(rest) * across;
            }
            EXPECT_LT(rest.norm(), k_rounding_um);
        }
    }
    for (const int n : n_found) EXPECT_GT(n, 0) << "inside, faces, edges and corners";
}

TEST(NearestInside, MovesByNoMoreThanThePoint) {
    const Polyhedron polyhedron(4);
    const Random random(4, 3);
    for (std::uint64_t i = 0; i < 200; ++i) {
        const Vec3 x = random_point(random, i, 4.0);
        const Vec3 moved = x + random_point(random, 1000 + i, 0.2);
        const Vec3 there = nearest_inside(polyhedron.pointers, x).point_um;
        const Vec3 then = nearest_inside(polyhedron.pointers, moved).point_um;
        EXPECT_LE((then - there).norm(), (moved - x).norm() + k_rounding_um);
    }
}

TEST(NearestInside, KnowsAPlaneThatIsThereTwice) {
    const Hull::Plane top{Vec3::UnitZ(), 1.0}, side{Vec3::UnitX(), 1.0};
    const std::vector<const Hull::Plane*> planes{&top, &top, &side, &top};
    const NearestInside found = nearest_inside(planes, Vec3(3.0, 5.0, 2.0));
    EXPECT_EQ(found.n_across, 2);
    EXPECT_LT((found.point_um - Vec3(1.0, 5.0, 1.0)).norm(), 1e-14);
}

}  // namespace
}  // namespace spheroscope
