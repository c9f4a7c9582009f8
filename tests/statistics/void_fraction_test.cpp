#include "engine/statistics/radial_profile.hpp"
#include "engine/statistics/void_fraction.hpp"
#include "tests/statistics/made_up_aggregate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace spheroscope::statistics {
namespace {

TEST(VoidFraction, OfOneCellIsZeroInsideItAndOneOutside) {
    const Aggregate cell = test::round_cells({Vec3(1, 2, 3)}, 9.0);
    const auto samples = void_samples(cell, random_probes(cell, 1));
    for (const ProfilePoint& point :
         pooled_profile(std::vector<std::vector<ProbeSample>>{samples})) {
        if (point.r < 0.95 || point.r > 1.05) {
            EXPECT_EQ(point.mean, point.r < 1.0 ? 0.0 : 1.0) << point.r;
        }
    }
    // The mesh has the volume of the sphere.
    const double share = 1.0 - 1.0 / std::pow(k_probe_reach, 3);
    EXPECT_NEAR(void_fraction(samples, k_probe_reach), share, 3 * std::sqrt(0.25 / 17280));
}

TEST(VoidFraction, OfTouchingSpheresOnAFaceCentredLatticeIsThatOfTheLattice) {
    std::vector<Vec3> centres;
    for (int i = -4; i <= 4; ++i)
        for (int j = -4; j <= 4; ++j)
            for (int k = -4; k <= 4; ++k) {
                const Vec3 at = std::sqrt(2.0) * Vec3(i, j, k);  // touching spheres of radius 1
                if ((i + j + k) % 2 == 0 && at.norm() < 5.7) centres.push_back(at);
            }
    const Aggregate packing = test::round_cells(centres, 1.0);
    const auto samples = void_samples(packing, random_probes(packing, 1));
    const double wanted = 1.0 - std::numbers::pi / std::sqrt(18.0);
    EXPECT_NEAR(void_fraction(samples, 0.9), wanted, 0.02);
}

TEST(VoidFraction, WithoutAProbeIsUndefined) { EXPECT_TRUE(std::isnan(void_fraction({}, 1.0))); }

}  // namespace
}  // namespace spheroscope::statistics
