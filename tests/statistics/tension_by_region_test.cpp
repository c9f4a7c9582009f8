#include "engine/statistics/tension_by_region.hpp"
#include "tests/statistics/made_up_aggregate.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace spheroscope::statistics {
namespace {

constexpr std::size_t k_rim = 0, k_inner = 1, k_core = 2, k_pore = 3;

/// A core cell in the middle, and 12 cells far away on the axes, which touch with the half that
/// faces the middle.
Aggregate core_and_rim(int n_nodes) {
    std::vector<Vec3> centres{Vec3::Zero()};
    for (const Vec3& axis : std::vector<Vec3>{Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()})
        for (const double distance : {-1200.0, -1000.0, 1000.0, 1200.0})
            centres.emplace_back(distance * axis);
    Aggregate aggregate = test::round_cells(centres, 9.0, n_nodes);
    const MeshTopology& mesh = *aggregate.topology;
    for (std::size_t c = 0; c < centres.size(); ++c)
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
            Vec3 centroid = Vec3::Zero();
            for (const int node : mesh.triangles[t])
                centroid += mesh.unit_shape[static_cast<std::size_t>(node)] / 3.0;
            const bool touches = c == 0 ? centroid.z() < 0.0 : centroid.dot(centres[c]) < 0.0;
            if (touches) aggregate.sigma_nn_kPa[c * mesh.triangles.size() + t] = 1.0;
        }
    return aggregate;
}

TEST(TensionByRegion, IsTheAreaMeanOverTheFacesOfEachRegion) {
    Aggregate aggregate = core_and_rim(642);
    ASSERT_TRUE(aggregate.is_core(0));
    const std::size_t n = aggregate.topology->unit_shape.size();
    for (std::size_t i = 0; i < aggregate.x_um.size(); ++i) {
        const Vec3& on_sphere = aggregate.topology->unit_shape[i % n];
        const Vec3& centre = aggregate.centre_um[i / n];
        // the cosine to the aggregate's middle in the rim; two values in the core
        aggregate.gamma_eff_nN_per_um[i] = i < n ? (on_sphere.z() < 0.05 ? 2.0 : 5.0)
                                                 : on_sphere.normalized().dot(centre.normalized());
    }
    const std::array<double, 4> mean = tension_by_region(aggregate);
    EXPECT_NEAR(mean[k_rim], 0.5, 0.05) << "mean cosine over a hemisphere";
    EXPECT_NEAR(mean[k_inner], -0.75, 0.02) << "and over a cap of 60 degrees";
    EXPECT_NEAR(mean[k_core], 2.0, 0.3);
    EXPECT_NEAR(mean[k_pore], 5.0, 1e-12);
}

TEST(TensionByRegion, IsUndefinedWhereThereIsNoSuchFace) {
    const Aggregate alone = test::round_cells({Vec3::Zero()}, 9.0, 42);
    const std::array<double, 4> mean = tension_by_region(alone);
    EXPECT_TRUE(std::isnan(mean[k_core]));
    EXPECT_EQ(mean[k_rim], 0.0);
    Aggregate without_springs = core_and_rim(42);
    without_springs.gamma_eff_nN_per_um.clear();
    for (const double value : tension_by_region(without_springs)) EXPECT_TRUE(std::isnan(value));
}

}  // namespace
}  // namespace spheroscope::statistics
