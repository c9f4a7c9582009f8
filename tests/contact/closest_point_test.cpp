#include "engine/base/random.hpp"
#include "engine/contact/closest_point.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace spheroscope::test {
namespace {

TEST(ClosestPoint, IsNoFartherThanAnyPointOfTheTriangleAndExactOnItsFeatures) {
    const Random random(3, 0);
    int n_faces = 0, n_edges = 0, n_corners = 0;
    for (std::uint64_t trial = 0; trial < 3000; ++trial) {
        const auto vector = [&](std::uint32_t k) {
            return Vec3(random.normal(trial, 3 * k), random.normal(trial, 3 * k + 1),
                        random.normal(trial, 3 * k + 2));
        };
        const Vec3 a = vector(0), b = vector(1), c = vector(2), p = 2.0 * vector(3);
        const auto w = closest_barycentric(p, a, b, c);
        EXPECT_NEAR(w[0] + w[1] + w[2], 1.0, 1e-12);
        EXPECT_GE(*std::min_element(w.begin(), w.end()), 0.0);
        // The nearest point of a convex set: nothing of it lies beyond the plane through the point
        // across the line to p.
        const Vec3 q = w[0] * a + w[1] * b + w[2] * c;
        for (const Vec3& corner : {a, b, c})
            EXPECT_LE((corner - q).dot(p - q), 1e-10 * (1.0 + p.squaredNorm()));
        const auto zeros = std::count(w.begin(), w.end(), 0.0);
        ++(zeros == 0 ? n_faces : zeros == 1 ? n_edges : n_corners);
    }
    EXPECT_GT(std::min({n_faces, n_edges, n_corners}), 100) << "every feature must have been met";
}

}  // namespace
}  // namespace spheroscope::test
