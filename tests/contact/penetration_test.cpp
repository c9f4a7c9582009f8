// Nodes inside another cell, against the distance from its centre.
#include "engine/contact/penetration.hpp"
#include "tests/reference/made_up_cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace spheroscope::test {
namespace {

std::optional<Penetration> between_spheres(int n_nodes, double overlap_um, double limit_um,
                                           std::uint64_t seed = 1) {
    const Cluster cells = make_doublet(n_nodes, seed, 9.0, 9.0, overlap_um);
    Workers workers(2);
    return deepest_penetration(cells.model, cells.x_um, limit_um, workers);
}

TEST(Penetration, SpheresThatOverlapByLessThanTheLimitHaveNone) {
    for (const double overlap_um : {-3.0, -0.3, 0.3, 0.9})
        EXPECT_FALSE(between_spheres(162, overlap_um, 1.0)) << overlap_um;
}

TEST(Penetration, OfSpheresIsTheirOverlapToAnEdgesHeight) {
    for (const int n_nodes : {42, 162, 642})
        for (const double overlap_um : {3.0, 8.5, 12.0}) {
            const auto found = between_spheres(n_nodes, overlap_um, 1.0);
            ASSERT_TRUE(found) << n_nodes << " " << overlap_um;
            EXPECT_NE(found->cell, found->other);
            // Of a sphere that reaches beyond the centre of the other one, the deepest point is the
            // one nearest to that centre. The nearest node may be half an edge beside the axis, a
            // facet below the sphere.
            const double deepest_um = std::min(overlap_um, 18.0 - overlap_um);
            EXPECT_GT(found->depth_um, deepest_um - 1.8);
            EXPECT_LT(found->depth_um, deepest_um + 0.8);
        }
}

TEST(Penetration, OfACellInsideAnotherOneIsSeenAlthoughNoSurfacesMeet) {
    Cluster cells = make_doublet(162, 1, 9.0, 9.0, 0.0);
    const auto n = static_cast<std::size_t>(cells.model.n_nodes());
    const auto centre = [&](std::size_t cell) {
        Vec3 sum = Vec3::Zero();
        for (std::size_t i = 0; i < n; ++i) sum += cells.x_um[cell * n + i];
        return Vec3(sum / static_cast<double>(n));
    };
    const Vec3 home = centre(0), there = centre(1);
    for (std::size_t i = 0; i < n; ++i)
        cells.x_um[n + i] = home + 0.5 * (cells.x_um[n + i] - there);
    Workers workers(1);
    const auto found = deepest_penetration(cells.model, cells.x_um, 1.0, workers);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->cell, 1);
    EXPECT_EQ(found->other, 0);
    EXPECT_NEAR(found->depth_um, 4.5, 0.4);
}

TEST(Penetration, MirrorImagesHaveNodesExactlyAboveEachOther) {
    // node upon node along the ray
    const auto model = make_model(make_icosphere(162), {9.0, 9.0});
    std::vector<Vec3> x_um;
    for (const double side : {-1.0, 1.0})
        for (const Vec3& node : model.topology->unit_shape)
            x_um.push_back(9.0 * node + Vec3(0.0, 0.0, side * 6.0));
    Workers workers(1);
    const auto found = deepest_penetration(model, x_um, 1.0, workers);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->depth_um, 6.0, 0.8);
}

}  // namespace
}  // namespace spheroscope::test
