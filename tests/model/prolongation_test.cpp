#include "engine/base/index.hpp"
#include "engine/model/prolongation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

namespace spheroscope {
namespace {

/// Largest departure of the nodes from their mean distance to the origin, over that distance.
double roughness(const std::vector<Vec3>& x) {
    double mean = 0.0, largest = 0.0;
    for (const Vec3& node : x) mean += node.norm() / static_cast<double>(x.size());
    for (const Vec3& node : x) largest = std::max(largest, std::abs(node.norm() - mean));
    return largest / mean;
}

TEST(Prolongation, KeepsASphereMuchRounderThanPlainMiddlesOfEdges) {
    for (const int n_nodes : {42, 162, 642}) {
        const auto coarse = make_icosphere(n_nodes);
        const auto fine = make_icosphere(4 * n_nodes - 6);
        const Prolongation prolongation(coarse, fine);
        const std::vector<Vec3> x =
            prolongation.positions(std::span<const Vec3>(coarse->unit_shape));
        ASSERT_EQ(static_cast<int>(x.size()), fine->n_nodes());
        std::vector<Vec3> plain(coarse->unit_shape);
        for (std::size_t i = plain.size(); i < x.size(); ++i) {
            Vec3 middle = Vec3::Zero();
            for (int k = fine->neighbour_begin[i]; k < fine->neighbour_begin[i + 1]; ++k)
                if (fine->neighbours[idx(k)] < n_nodes)
                    middle += 0.5 * coarse->unit_shape[idx(fine->neighbours[idx(k)])];
            plain.push_back(middle);
        }
        EXPECT_LT(roughness(x), 0.4 * roughness(plain)) << n_nodes;
        EXPECT_NEAR(enclosed_volume(fine->triangles, x), 4.0 / 3.0 * std::numbers::pi, 1e-12);
    }
}

TEST(Prolongation, LeavesOldNodesWhereTheyAreUpToTheScaleOfTheVolume) {
    const auto coarse = make_icosphere(162), fine = make_icosphere(642);
    std::vector<Vec3> x(coarse->unit_shape);
    for (Vec3& node : x)
        node = Vec3(1e3, 2.0, 3.0) + Vec3(9.0 * node.x(), 7.0 * node.y(), node.z());
    const std::vector<Vec3> y = Prolongation(coarse, fine).positions(x);
    EXPECT_NEAR(enclosed_volume(fine->triangles, y), enclosed_volume(coarse->triangles, x),
                1e-9 * enclosed_volume(coarse->triangles, x));
    const double scale = (y[1] - y[0]).norm() / (x[1] - x[0]).norm();
    EXPECT_NEAR(scale, 1.0, 0.01);
    for (std::size_t i = 1; i < x.size(); ++i)
        EXPECT_LT((y[i] - y[0] - scale * (x[i] - x[0])).norm(), 1e-9);
}

TEST(Prolongation, KeepsAFlatContactFlat) {
    // A sphere whose cap is pressed flat: new nodes with an all-flat stencil lie in the plane.
    const auto coarse = make_icosphere(162), fine = make_icosphere(642);
    const double plane = 0.5;
    std::vector<Vec3> x(coarse->unit_shape);
    for (Vec3& node : x) node.z() = std::min(node.z(), plane);
    const std::vector<Vec3> y = Prolongation(coarse, fine).positions(x);
    double top = 0.0;
    for (std::size_t i = 0; i < 162; ++i) top = std::max(top, y[i].z());
    int n_flat = 0;
    for (std::size_t i = 162; i < y.size(); ++i)
        if (std::hypot(y[i].x(), y[i].y()) < 0.35 && y[i].z() > 0.0) {
            EXPECT_NEAR(y[i].z(), top, 1e-12);
            ++n_flat;
        }
    EXPECT_GT(n_flat, 10);
}

TEST(Prolongation, OverTwoLevelsIsOneAfterTheOther) {
    const auto a = make_icosphere(42), b = make_icosphere(162), c = make_icosphere(642);
    const std::span<const Vec3> x(a->unit_shape);
    const std::vector<Vec3> middle = Prolongation(a, b).positions(x);
    const std::vector<Vec3> two_steps = Prolongation(b, c).positions(middle);
    const std::vector<Vec3> at_once = Prolongation(a, c).positions(x);
    for (std::size_t i = 0; i < at_once.size(); ++i)
        EXPECT_LT((at_once[i] - two_steps[i]).norm(), 1e-13);
}

TEST(Prolongation, GivesATriangleItsParentAndANewNodeTheMeanOfItsEdge) {
    const auto coarse = make_icosphere(42), fine = make_icosphere(642);
    const Prolongation prolongation(coarse, fine);
    for (int t = 0; t < fine->n_triangles(); ++t) {
        Vec3 centre = Vec3::Zero(), parent = Vec3::Zero();
        for (const int node : fine->triangles[idx(t)]) centre += fine->unit_shape[idx(node)] / 3.0;
        for (const int node : coarse->triangles[idx(prolongation.parent(t))])
            parent += coarse->unit_shape[idx(node)] / 3.0;
        EXPECT_LT((centre - parent).norm(), 0.45) << t;  // of 320 triangles' 0.6 um across
    }
    // Along z a linear function of the nodes stays one up to the bulge of the sphere.
    std::vector<float> z;
    for (const Vec3& node : coarse->unit_shape) z.push_back(static_cast<float>(node.z()));
    const std::vector<float> values = prolongation.node_values<float>(z);
    for (std::size_t i = 0; i < values.size(); ++i)
        EXPECT_NEAR(double{values[i]}, fine->unit_shape[i].z(), 0.15);
    z[0] = std::nanf("");
    const std::vector<float> with_gap = prolongation.node_values<float>(z);
    EXPECT_GT(std::count_if(with_gap.begin(), with_gap.end(), [](float v) { return v != v; }), 6);
}

}  // namespace
}  // namespace spheroscope
