#include "engine/base/error.hpp"
#include "engine/model/mesh_topology.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace spheroscope {
namespace {

struct KnownMesh {
    int n_nodes;
    double volume_ratio;  // of the polyhedron with its nodes on the unit sphere, over 4/3 pi
};

class Icosphere : public testing::TestWithParam<KnownMesh> {};

// C-7: the volumes of the unscaled polyhedra.
TEST_P(Icosphere, UnscaledPolyhedronHasItsKnownVolume) {
    const auto mesh = make_icosphere(GetParam().n_nodes);
    const double sphere_radius = mesh->unit_shape[0].norm();
    EXPECT_NEAR(1.0 / std::pow(sphere_radius, 3), GetParam().volume_ratio, 1e-4);
}

TEST_P(Icosphere, MeshVolumeIsThatOfTheSphereAtEveryLevel) {
    const auto mesh = make_icosphere(GetParam().n_nodes);
    EXPECT_NEAR(enclosed_volume(mesh->triangles, mesh->unit_shape), 4.0 / 3.0 * std::numbers::pi,
                1e-12);
}

TEST_P(Icosphere, SurfaceIsClosedAndSpherical) {
    const auto mesh = make_icosphere(GetParam().n_nodes);
    EXPECT_EQ(mesh->n_nodes(), GetParam().n_nodes);
    EXPECT_EQ(mesh->n_nodes() - mesh->n_edges() + mesh->n_triangles(), 2);  // Euler
    for (const MeshTopology::Edge& e : mesh->edges) {
        EXPECT_LT(e.i, e.j);
        const auto& left = mesh->triangles[static_cast<std::size_t>(e.left)];
        EXPECT_EQ(left[0] + left[1] + left[2], e.i + e.j + e.a);
    }
}

INSTANTIATE_TEST_SUITE_P(Levels, Icosphere,
                         testing::Values(KnownMesh{42, 0.87345}, KnownMesh{162, 0.96616},
                                         KnownMesh{642, 0.99139}, KnownMesh{2562, 0.99784}));

TEST(ClosedTopology, AnOpenSurfaceIsRefused) {
    EXPECT_THROW(static_cast<void>(make_closed_topology({{0, 1, 2}}, std::vector<Vec3>(3))), Error);
}

TEST(ClosedTopology, MixedWindingIsRefused) {
    auto triangles = make_icosphere(42)->triangles;
    std::swap(triangles[5][0], triangles[5][1]);
    EXPECT_THROW(static_cast<void>(make_closed_topology(triangles, make_icosphere(42)->unit_shape)),
                 Error);
}

}  // namespace
}  // namespace spheroscope
