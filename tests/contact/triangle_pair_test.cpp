#include "tests/contact/random_triangles.hpp"
#include "tests/reference/plain_contact.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace spheroscope::test {
namespace {

constexpr double k_h0_um = 0.3;
constexpr double k_W = 0.5;
const Random k_random(20, 5);

/// The law of the paper's scenes, and that of the 'wide' sensitivity row.
class TrianglePairs : public testing::TestWithParam<double> {
  protected:
    ContactLaw law = adhesive_law(k_W, k_h0_um, 2.0, GetParam());
};

Vec3 in_plane(const Vec3& v, const Vec3& n) { return v - n.dot(v) * n; }

TEST_P(TrianglePairs, NodalForcesHaveTheResultantAndMomentOfThePressureAndNoNetForceOrTorque) {
    int n_active = 0;
    for (std::uint64_t index = 0; index < 2500; ++index)
        for (const Facing facing : k_all_facings) {
            const TrianglePair t = random_pair(k_random, index, facing, k_h0_um);
            ContactPair pair;
            if (contact_of_triangles(triangle_of(t.a), triangle_of(t.b), law, pair) !=
                PairOutcome::active)
                continue;
            ++n_active;
            SCOPED_TRACE(testing::Message()
                         << "pair " << index << ", facing " << static_cast<int>(facing));
            const reference::PlainContact plain = reference::plain_contact(t.a, t.b, law);
            const double size_nN =
                law.P0_kPa * 0.5 * (t.a[1] - t.a[0]).cross(t.a[2] - t.a[0]).norm();
            double sum_a = 0.0, sum_b = 0.0;
            Vec3 moment_a = Vec3::Zero(), moment_b = Vec3::Zero();
            Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
            for (std::size_t i = 0; i < 3; ++i) {
                sum_a += pair.force_a_nN[i];
                sum_b += pair.force_b_nN[i];
                moment_a += pair.force_a_nN[i] * in_plane(t.a[i] - t.a[0], pair.normal);
                moment_b += pair.force_b_nN[i] * in_plane(t.b[i] - t.a[0], pair.normal);
                force += (pair.force_a_nN[i] - pair.force_b_nN[i]) * pair.normal;
                torque += pair.force_a_nN[i] * (t.a[i] - t.a[0]).cross(pair.normal) -
                          pair.force_b_nN[i] * (t.b[i] - t.a[0]).cross(pair.normal);
            }
            // Rounding: coordinates of up to 30 um, so differences of corners carry 1e-14 um.
            EXPECT_LE(std::abs(sum_a - pair.force_nN()), 1e-12 * size_nN);
            EXPECT_LE(std::abs(sum_b - pair.force_nN()), 1e-12 * size_nN);
            EXPECT_LE((moment_a - plain.first_moment_nN_um).norm(), 1e-12 * size_nN);
            EXPECT_LE((moment_b - plain.first_moment_nN_um).norm(), 1e-12 * size_nN);
            EXPECT_LE(force.norm(), 1e-12 * size_nN);
            EXPECT_LE(torque.norm(), 1e-12 * size_nN);
            EXPECT_LE(std::abs(pair.lambda[0] + pair.lambda[1] + pair.lambda[2] - 1.0), 1e-12);
            EXPECT_LE(std::abs(pair.mu[0] + pair.mu[1] + pair.mu[2] - 1.0), 1e-12);
            if (HasFailure()) return;
        }
    EXPECT_GT(n_active, 6000) << "the random pairs mostly touch";
}

TEST_P(TrianglePairs, EqualTheLongDoubleClipWithClosedFormMoments) {
    int n_active = 0, n_apart = 0;
    for (std::uint64_t index = 0; index < 2500; ++index)
        for (const Facing facing : k_all_facings) {
            const TrianglePair t = random_pair(k_random, index, facing, k_h0_um);
            const TriangleGeometry a = triangle_of(t.a), b = triangle_of(t.b);
            ContactPair pair;
            const PairOutcome outcome = contact_of_triangles(a, b, law, pair);
            if (a.normal.dot(b.normal) >= law.reject_cos) {
                EXPECT_EQ(outcome, PairOutcome::apart) << "rejected for its angle";
                continue;
            }
            const reference::PlainContact plain = reference::plain_contact(t.a, t.b, law);
            const double largest_um2 = 0.5 * (t.a[1] - t.a[0]).cross(t.a[2] - t.a[0]).norm();
            const double size_nN = law.P0_kPa * largest_um2;
            SCOPED_TRACE(testing::Message()
                         << "pair " << index << ", facing " << static_cast<int>(facing));
            if (outcome != PairOutcome::active) {
                ++n_apart;
                // Below 1e-9 um^2 a polygon is rounding.
                EXPECT_LE(plain.area_um2, 1.001e-9);
                continue;
            }
            ++n_active;
            EXPECT_NEAR(pair.area_um2, plain.area_um2, 1e-10 * largest_um2);
            EXPECT_NEAR(pair.force_nN(), plain.force_nN, 1e-10 * size_nN);
            EXPECT_NEAR(pair.energy_fJ, plain.energy_fJ, 1e-10 * size_nN * k_h0_um);
            for (std::size_t i = 0; i < 3; ++i) {
                EXPECT_NEAR(pair.force_a_nN[i], plain.force_a_nN[i], 1e-10 * size_nN);
                EXPECT_NEAR(pair.force_b_nN[i], plain.force_b_nN[i], 1e-10 * size_nN);
            }
            EXPECT_LE((pair.normal - plain.normal).norm(), 1e-14);
            // Where the polygon is, and its mean overlap, are ratios to its area.
            const double ratio_um = 1e-12 * largest_um2 / plain.area_um2;
            Vec3 in_a = -plain.centroid_um, in_b = -plain.centroid_um;
            for (std::size_t i = 0; i < 3; ++i) {
                in_a += pair.lambda[i] * t.a[i];
                in_b += pair.mu[i] * t.b[i];
            }
            EXPECT_LE(in_plane(in_a, plain.normal).norm(), 1e-12 + ratio_um);
            EXPECT_LE(in_plane(in_b, plain.normal).norm(), 1e-12 + ratio_um);
            EXPECT_NEAR(static_cast<double>(pair.overlap_um), plain.overlap_um, 1e-6 + ratio_um);
            if (HasFailure()) return;
        }
    EXPECT_GT(n_active, 6000);
    EXPECT_GT(n_apart, 100);
}

TEST_P(TrianglePairs, SwappingTheTrianglesSwapsTheForces) {
    for (std::uint64_t index = 0; index < 300; ++index) {
        const TrianglePair t = random_pair(k_random, index, Facing::tilted, k_h0_um);
        ContactPair ab, ba;
        if (contact_of_triangles(triangle_of(t.a), triangle_of(t.b), law, ab) !=
            PairOutcome::active)
            continue;
        ASSERT_EQ(contact_of_triangles(triangle_of(t.b), triangle_of(t.a), law, ba),
                  PairOutcome::active);
        EXPECT_LE((ab.normal + ba.normal).norm(), 1e-14);
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_NEAR(ab.force_a_nN[i], ba.force_b_nN[i], 1e-12);
            EXPECT_NEAR(ab.force_b_nN[i], ba.force_a_nN[i], 1e-12);
            EXPECT_NEAR(ab.lambda[i], ba.mu[i], 1e-9);
            EXPECT_NEAR(ab.mu[i], ba.lambda[i], 1e-9);
        }
    }
}

TEST_P(TrianglePairs, APairOverItsLargestOverlapIsCountedAndNoContact) {
    const std::array<Vec3, 3> b = flat_triangle(k_random, 3);
    const auto at_overlap = [&](double overlap_um) {
        const std::array<Vec3, 3> a =
            moved(turned_over(b), Mat3::Identity(), Vec3(0.0, 0.0, 2.0 * k_h0_um - overlap_um));
        ContactPair pair;
        return contact_of_triangles(triangle_of(a), triangle_of(b), law, pair);
    };
    EXPECT_EQ(at_overlap(law.largest_overlap_um - 1e-9), PairOutcome::active);
    EXPECT_EQ(at_overlap(law.largest_overlap_um + 1e-9), PairOutcome::too_deep);
}

TEST_P(TrianglePairs, AreRejectedFromTheirAngleOn) {
    // Two triangles that meet in an edge of the wedge, with n_A . n_B just below and above the
    // limit.
    const auto outcome_at = [&](double cosine) {
        const double half_wedge = 0.5 * (std::numbers::pi - std::acos(cosine));
        const Mat3 up = Eigen::AngleAxisd(half_wedge, Vec3::UnitX()).toRotationMatrix();
        const std::array<Vec3, 3> b = flat_triangle(k_random, 8);
        ContactPair pair;
        return contact_of_triangles(triangle_of(moved(turned_over(b), up, Vec3::Zero())),
                                    triangle_of(moved(b, up.transpose(), Vec3::Zero())), law, pair);
    };
    EXPECT_EQ(outcome_at(law.reject_cos - 1e-9), PairOutcome::active);
    EXPECT_EQ(outcome_at(law.reject_cos + 1e-9), PairOutcome::apart);
}

INSTANTIATE_TEST_SUITE_P(RejectCos, TrianglePairs, testing::Values(0.0, 0.3),
                         [](const auto& tested) { return tested.param == 0.0 ? "0" : "0_3"; });

}  // namespace
}  // namespace spheroscope::test
