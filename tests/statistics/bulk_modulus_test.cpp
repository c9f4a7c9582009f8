#include "engine/statistics/bulk_modulus.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace spheroscope::statistics {
namespace {

constexpr double k_free_um = 50.0;

/// A wall around something that is as stiff as this, from its free radius inward, then held with a
/// share of the pressure, then gone.
std::vector<WallPoint> compaction(double modulus_kPa, double held_share, int n_held) {
    std::vector<WallPoint> wall;
    const auto add = [&](double radius_um, double share) {
        const double pressure_kPa = share * modulus_kPa * 3.0 * std::log(k_free_um / radius_um);
        wall.push_back({radius_um, pressure_kPa * 4.0 * std::numbers::pi * radius_um * radius_um});
    };
    for (int i = 0; i <= 20; ++i) add(k_free_um - 0.2 * i, 1.0);
    for (int i = 0; i < n_held; ++i) add(k_free_um - 4.0, held_share);
    for (int i = 1; i < 5; ++i) wall.push_back({k_free_um - 4.0 + 2.0 * i, 0.0});
    return wall;
}

TEST(BulkModulus, IsThatOfAnElasticBall) {
    const std::vector<WallPoint> wall = compaction(2.5, 1.0, 3);
    EXPECT_NEAR(bulk_modulus_moving_kPa(wall), 2.5, 1e-9);
    EXPECT_NEAR(bulk_modulus_held_kPa(wall, k_free_um), 2.5, 1e-9);
}

TEST(BulkModulus, HasFrictionWhileTheWallMovesAndNoneWhereItIsHeld) {
    const std::vector<WallPoint> wall = compaction(2.5, 0.4, 3);
    EXPECT_NEAR(bulk_modulus_moving_kPa(wall), 2.5, 1e-9);
    EXPECT_NEAR(bulk_modulus_held_kPa(wall, k_free_um), 1.0, 1e-9);
}

TEST(BulkModulus, IsUndefinedWithoutWhatItIsMeasuredBy) {
    EXPECT_TRUE(std::isnan(bulk_modulus_moving_kPa({})));
    EXPECT_TRUE(std::isnan(bulk_modulus_held_kPa({}, 50.0)));
    EXPECT_TRUE(std::isnan(bulk_modulus_held_kPa(compaction(2.5, 1.0, 0), k_free_um)));
    // The free aggregate is smaller than the held one.
    EXPECT_TRUE(std::isnan(bulk_modulus_held_kPa(compaction(2.5, 1.0, 3), 40.0)));
}

}  // namespace
}  // namespace spheroscope::statistics
