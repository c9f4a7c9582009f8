#include "engine/statistics/stress_at_pores.hpp"
#include "tests/statistics/made_up_aggregate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace spheroscope::statistics {
namespace {

/// A core cell in the middle of twelve others that are far away.
Aggregate core_cell(int n_nodes) {
    std::vector<Vec3> centres{Vec3::Zero()};
    for (const Vec3& axis : std::vector<Vec3>{Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()})
        for (const double distance : {-1200.0, -1000.0, 1000.0, 1200.0})
            centres.emplace_back(distance * axis);
    return test::round_cells(centres, 9.0, n_nodes);
}

// One free triangle: the triangles around its corners are at the pore.
TEST(StressAtPores, IsThatOfTheTrianglesAroundFreeOnes) {
    Aggregate aggregate = core_cell(162);
    ASSERT_TRUE(aggregate.is_core(0));
    const MeshTopology& mesh = *aggregate.topology;
    const auto& hole = mesh.triangles[0];
    double area_um2 = 0.0, force_nN = 0.0;
    for (std::size_t t = 1; t < mesh.triangles.size(); ++t) {
        int shared = 0;
        for (const int node : mesh.triangles[t])
            for (const int corner : hole) shared += node == corner ? 1 : 0;
        const double sigma_kPa = shared > 0 ? -0.5 - 0.25 * shared : 0.125;
        aggregate.sigma_nn_kPa[t] = sigma_kPa;
        if (shared == 0) continue;
        area_um2 += aggregate.triangle_area_um2[t];
        force_nN += sigma_kPa * aggregate.triangle_area_um2[t];
    }
    // what other cells carry is no stress of the core
    aggregate.sigma_nn_kPa[mesh.triangles.size()] = 100.0;
    const StressAtPores stress = stress_at_pores(aggregate);
    EXPECT_NEAR(stress.at_pores_kPa, force_nN / area_um2, 1e-12);
    EXPECT_NEAR(stress.elsewhere_kPa, 0.125, 1e-12);
}

TEST(StressAtPores, IsUndefinedWithoutPoresOrContacts) {
    Aggregate aggregate = core_cell(42);
    EXPECT_TRUE(std::isnan(stress_at_pores(aggregate).at_pores_kPa)) << "nothing touches";
    std::fill_n(aggregate.sigma_nn_kPa.begin(), aggregate.topology->triangles.size(), 1.0);
    EXPECT_TRUE(std::isnan(stress_at_pores(aggregate).at_pores_kPa)) << "everything touches";
    EXPECT_NEAR(stress_at_pores(aggregate).elsewhere_kPa, 1.0, 1e-12);
}

}  // namespace
}  // namespace spheroscope::statistics
