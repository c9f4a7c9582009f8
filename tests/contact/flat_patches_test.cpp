// Two flat patches of many triangles against each other: the law of the contact, whatever the
// meshes.
#include "tests/contact/random_triangles.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace spheroscope::test {
namespace {

constexpr double k_side_um = 20.0;
constexpr int k_divisions = 12;

using Patch = std::vector<TriangleGeometry>;

/// A square of side 20 um about the z axis, turned about it; face up or down.
Patch make_patch(double z_um, double angle_rad, bool faces_up) {
    const Mat3 turn = Eigen::AngleAxisd(angle_rad, Vec3::UnitZ()).toRotationMatrix();
    const auto at = [&](int i, int j) {
        return Vec3(turn * Vec3(k_side_um * (static_cast<double>(i) / k_divisions - 0.5),
                                k_side_um * (static_cast<double>(j) / k_divisions - 0.5), z_um));
    };
    Patch patch;
    const auto add = [&](const std::array<Vec3, 3>& up) {
        TriangleGeometry triangle = triangle_of(faces_up ? up : turned_over(up));
        triangle.normal = Vec3(0.0, 0.0, faces_up ? 1.0 : -1.0);
        patch.push_back(triangle);
    };
    for (int i = 0; i < k_divisions; ++i)
        for (int j = 0; j < k_divisions; ++j) {
            add({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            add({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    return patch;
}

struct Sum {
    double area_um2 = 0.0;
    double force_nN = 0.0;  ///< > 0 pushes the patches apart
    std::vector<double> area_of_upper_um2;
};

/// The upper patch over the lower one, at this gap, turned against it.
Sum contact_of_patches(double gap_um, double angle_rad, const ContactLaw& law) {
    const Patch upper = make_patch(gap_um, angle_rad, false), lower = make_patch(0.0, 0.0, true);
    Sum sum;
    for (const TriangleGeometry& a : upper) {
        double area_um2 = 0.0;
        for (const TriangleGeometry& b : lower) {
            ContactPair pair;
            if (contact_of_triangles(a, b, law, pair) != PairOutcome::active) continue;
            area_um2 += pair.area_um2;
            sum.force_nN += pair.force_nN() * pair.normal.z();
        }
        sum.area_um2 += area_um2;
        sum.area_of_upper_um2.push_back(area_um2);
    }
    return sum;
}

/// What two squares of this side have in common when one is turned about their centre.
double common_area_um2(double angle_rad) {
    return 2.0 * k_side_um * k_side_um /
           (1.0 + std::abs(std::sin(angle_rad)) + std::abs(std::cos(angle_rad)));
}

struct Reading {
    const char* name;
    double W_over_omega;
    double equilibrium_overlap_h0;
};

class FlatPatches : public testing::TestWithParam<Reading> {
  protected:
    static constexpr double omega = 0.5, h0_um = 0.3;
    ContactLaw law = adhesive_law(GetParam().W_over_omega * omega, h0_um,
                                  GetParam().equilibrium_overlap_h0, 0.0);
    double angle_rad = 1.2345;
};

TEST_P(FlatPatches, FollowTheLawExactlyFromTouchingToOutOfRange) {
    const double area_um2 = common_area_um2(angle_rad);
    for (int step = 0; step <= 30; ++step) {
        const double gap_um = 0.1 * step * h0_um;
        const Sum sum = contact_of_patches(gap_um, angle_rad, law);
        // At a gap of 2 h0 itself the last bit decides.
        if (step == 20) continue;
        if (gap_um < 2.0 * h0_um) {
            const double expected_kPa = law.k_kPa_per_um * (2.0 * h0_um - gap_um) - law.P0_kPa;
            EXPECT_NEAR(sum.area_um2, area_um2, 1e-10 * area_um2) << "gap " << gap_um;
            EXPECT_NEAR(sum.force_nN / area_um2, expected_kPa, 1e-10 * law.P0_kPa)
                << "gap " << gap_um;
        } else {
            EXPECT_EQ(sum.force_nN, 0.0) << "gap " << gap_um;
            EXPECT_EQ(sum.area_um2, 0.0) << "gap " << gap_um;
        }
    }
    const Sum last = contact_of_patches(2.0 * h0_um * (1.0 - 1e-12), angle_rad, law);
    EXPECT_NEAR(last.force_nN / area_um2, -law.P0_kPa, 1e-10 * law.P0_kPa) << "largest tension";
}

TEST_P(FlatPatches, TakeTheWorkOfAdhesionToSeparate) {
    // P is linear between the equilibrium gap and 2 h0, so the trapezoidal rule is exact.
    const double start_um = 2.0 * h0_um - GetParam().equilibrium_overlap_h0 * h0_um;
    const double end_um = 2.0 * h0_um * (1.0 - 1e-12);
    constexpr int n = 8;
    double work_fJ = 0.0, before_nN = contact_of_patches(start_um, angle_rad, law).force_nN;
    EXPECT_NEAR(before_nN, 0.0, 1e-9) << "equilibrium";
    for (int i = 1; i <= n; ++i) {
        const double gap_um = start_um + (end_um - start_um) * i / n;
        const double force_nN = contact_of_patches(gap_um, angle_rad, law).force_nN;
        work_fJ -= 0.5 * (before_nN + force_nN) * (end_um - start_um) / n;
        before_nN = force_nN;
    }
    const double W = work_fJ / common_area_um2(angle_rad);
    EXPECT_NEAR(W, GetParam().W_over_omega * omega, 1e-10);
    EXPECT_NEAR(law.work_of_adhesion_nN_per_um(), W, 1e-10);
    // Printed constants: P0 = omega / h0 for I and II, twice that for III and IV.
    const double P0 =
        (GetParam().W_over_omega * 2.0 / GetParam().equilibrium_overlap_h0) * omega / h0_um;
    EXPECT_NEAR(law.P0_kPa, P0, 1e-12);
}

TEST_P(FlatPatches, CoverEachOtherOnceWhateverTheirAngle) {
    const Random random(9, 9);
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
        const double angle = 2.0 * std::numbers::pi * random.uniform(seed);
        const Patch upper = make_patch(0.2, angle, false);
        const Sum sum = contact_of_patches(0.2, angle, law);
        EXPECT_NEAR(sum.area_um2, common_area_um2(angle), 1e-9 * sum.area_um2);
        int n_inside = 0;
        for (std::size_t t = 0; t < upper.size(); ++t) {
            double farthest_um = 0.0;
            for (const Vec3& x : upper[t].corner_um)
                farthest_um = std::max(farthest_um, std::hypot(x.x(), x.y()));
            if (farthest_um > 0.5 * k_side_um) continue;
            ++n_inside;
            const auto& x = upper[t].corner_um;
            const double area_um2 = 0.5 * (x[1] - x[0]).cross(x[2] - x[0]).norm();
            EXPECT_NEAR(sum.area_of_upper_um2[t] / area_um2, 1.0, 1e-10);
        }
        EXPECT_GT(n_inside, 100);
    }
}

INSTANTIATE_TEST_SUITE_P(Readings, FlatPatches,
                         testing::Values(Reading{"I", 0.5, 1.0}, Reading{"II", 1.0, 2.0},
                                         Reading{"III", 1.0, 1.0}, Reading{"IV", 2.0, 2.0}),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace spheroscope::test
