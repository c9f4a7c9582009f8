// How the force of a pair depends on where its triangles are: steady where the pair is tilted or
// already overlaps, linear between the kinks, and a jump where two parallel faces first touch.
#include "tests/contact/random_triangles.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace spheroscope::test {
namespace {

constexpr double k_h0_um = 0.3;
const Random k_random(21, 5);

/// The forces on all six nodes, nN; zero if there is no contact.
Eigen::Matrix<double, 3, 6> node_forces(const TrianglePair& t, const ContactLaw& law) {
    Eigen::Matrix<double, 3, 6> F = Eigen::Matrix<double, 3, 6>::Zero();
    ContactPair pair;
    if (contact_of_triangles(triangle_of(t.a), triangle_of(t.b), law, pair) == PairOutcome::active)
        for (int i = 0; i < 3; ++i) {
            F.col(i) = pair.force_a_nN[static_cast<std::size_t>(i)] * pair.normal;
            F.col(3 + i) = -pair.force_b_nN[static_cast<std::size_t>(i)] * pair.normal;
        }
    return F;
}

/// Largest change of the forces from one step to the next, on the way from one pair to the other.
double largest_jump_nN(const TrianglePair& from, const TrianglePair& to, int n_steps,
                       const ContactLaw& law) {
    double largest = 0.0;
    Eigen::Matrix<double, 3, 6> before = node_forces(from, law);
    for (int step = 1; step <= n_steps; ++step) {
        const double s = static_cast<double>(step) / n_steps;
        TrianglePair t;
        for (std::size_t i = 0; i < 3; ++i) {
            t.a[i] = (1.0 - s) * from.a[i] + s * to.a[i];
            t.b[i] = (1.0 - s) * from.b[i] + s * to.b[i];
        }
        const Eigen::Matrix<double, 3, 6> now = node_forces(t, law);
        largest = std::max(largest, (now - before).norm());
        before = now;
    }
    return largest;
}

/// B at rest with its face up, A over it at this gap, with its face down; both equal seen from
/// above.
TrianglePair facing_at(double gap_um, double tilt_rad = 0.0) {
    const std::array<Vec3, 3> b = flat_triangle(k_random, 1);
    const Mat3 turn = Eigen::AngleAxisd(tilt_rad, Vec3(0.6, 0.8, 0.0)).toRotationMatrix();
    return {moved(turned_over(b), turn, Vec3(0.0, 0.0, gap_um)), b};
}

double pushing_force_nN(const TrianglePair& t, const ContactLaw& law) {
    ContactPair pair;
    const PairOutcome outcome = contact_of_triangles(triangle_of(t.a), triangle_of(t.b), law, pair);
    return outcome == PairOutcome::active ? pair.force_nN() : 0.0;
}

class PairForce : public testing::TestWithParam<double> {
  protected:
    ContactLaw law = adhesive_law(0.5, k_h0_um, 2.0, GetParam());
};

TEST_P(PairForce, IsContinuousInTheCoordinatesOfTiltedPairs) {
    // Steps ten times as small make the largest change ten times as small; a jump would stay.
    const Random random(4, 6);
    int n_moving = 0;
    for (std::uint64_t index = 0; index < 40; ++index) {
        const TrianglePair from = random_pair(random, index, Facing::tilted, k_h0_um);
        TrianglePair to = from;
        for (std::uint32_t i = 0; i < 3; ++i)
            for (std::uint32_t k = 0; k < 3; ++k) {
                to.a[i][k] += 0.2 * (random.uniform(index, 100 + 3 * i + k) - 0.5);
                to.b[i][k] += 0.2 * (random.uniform(index, 200 + 3 * i + k) - 0.5);
            }
        const double cosine = triangle_of(from.a).normal.dot(triangle_of(from.b).normal);
        const double cosine_to = triangle_of(to.a).normal.dot(triangle_of(to.b).normal);
        // Pairs that pass through parallel or through the rejected angle on their way do jump.
        if (cosine < -0.97 || std::max(cosine, cosine_to) > law.reject_cos - 0.1) continue;
        const double coarse_nN = largest_jump_nN(from, to, 100, law);
        if (coarse_nN == 0.0) continue;
        ++n_moving;
        EXPECT_LE(largest_jump_nN(from, to, 1000, law), 0.15 * coarse_nN) << "pair " << index;
    }
    EXPECT_GE(n_moving, 15);
}

TEST_P(PairForce, IsContinuousThroughParallelOnceThePairOverlaps) {
    const auto tilted = [](double tilt_rad) { return facing_at(0.2, tilt_rad); };
    double coarse_nN = 0.0, fine_nN = 0.0;
    for (int i = -50; i < 50; ++i)
        coarse_nN = std::max(
            coarse_nN,
            (node_forces(tilted(1e-3 * (i + 1)), law) - node_forces(tilted(1e-3 * i), law)).norm());
    for (int i = -500; i < 500; ++i)
        fine_nN = std::max(
            fine_nN,
            (node_forces(tilted(1e-4 * (i + 1)), law) - node_forces(tilted(1e-4 * i), law)).norm());
    EXPECT_GT(coarse_nN, 0.0);
    EXPECT_LE(fine_nN, 0.15 * coarse_nN);
}

TEST_P(PairForce, OfParallelFacesJumpsByP0TimesTheAreaAtFirstTouch) {
    const std::array<Vec3, 3> b = facing_at(0.0).b;
    const double area_um2 = 0.5 * (b[1] - b[0]).cross(b[2] - b[0]).norm();
    const double before_nN = pushing_force_nN(facing_at(2.0 * k_h0_um + 1e-12), law);
    const double after_nN = pushing_force_nN(facing_at(2.0 * k_h0_um - 1e-12), law);
    EXPECT_EQ(before_nN, 0.0);
    EXPECT_NEAR(after_nN, -law.P0_kPa * area_um2, 1e-10 * law.P0_kPa * area_um2);
}

TEST_P(PairForce, OfATiltedPairRisesFromZeroWithTheStatedSteepness) {
    // While the line delta = 0 sweeps over the pair, |dF| stays within P0 L / (2 tan(tilt/2)) + k S
    // per um.
    const double tilt_rad = 0.05, step_um = 1e-5;
    const double longest_um = 2.4;  // no chord of the triangle is longer
    const double largest_slope =
        law.P0_kPa * longest_um / (2.0 * std::tan(tilt_rad / 2.0)) + law.k_kPa_per_um * 3.0;
    double steepest = 0.0;
    for (double gap_um = 0.5; gap_um < 0.75; gap_um += 1e-3)
        steepest = std::max(steepest,
                            std::abs(pushing_force_nN(facing_at(gap_um + step_um, tilt_rad), law) -
                                     pushing_force_nN(facing_at(gap_um, tilt_rad), law)) /
                                step_um);
    EXPECT_LE(steepest, largest_slope);
    EXPECT_GE(steepest, 0.1 * largest_slope) << "the bound says something";
}

TEST_P(PairForce, OfParallelFacesHasTheSlopeOfTheLawOnBothSidesOfEveryKink) {
    const std::array<Vec3, 3> b = facing_at(0.0).b;
    const double area_um2 = 0.5 * (b[1] - b[0]).cross(b[2] - b[0]).norm();
    const double slope = -law.k_kPa_per_um * area_um2;  // by the gap
    const double beside_um = 1e-3 * k_h0_um, step_um = 0.1 * beside_um;
    const auto slope_at = [&](double gap_um) {
        return (pushing_force_nN(facing_at(gap_um + step_um), law) -
                pushing_force_nN(facing_at(gap_um - step_um), law)) /
               (2.0 * step_um);
    };
    for (const double kink_um : {0.0, k_h0_um}) {  // gaps of zero energy slope for both presets
        EXPECT_NEAR(slope_at(kink_um - beside_um), slope, 1e-7 * std::abs(slope));
        EXPECT_NEAR(slope_at(kink_um + beside_um), slope, 1e-7 * std::abs(slope));
    }
    EXPECT_NEAR(slope_at(2.0 * k_h0_um - beside_um), slope, 1e-7 * std::abs(slope));
    EXPECT_EQ(slope_at(2.0 * k_h0_um + beside_um), 0.0);
    // One-sided at first touch: from inside only.
    const double edge_um = 2.0 * k_h0_um * (1.0 - 1e-12);
    const double from_inside = (pushing_force_nN(facing_at(edge_um), law) -
                                pushing_force_nN(facing_at(edge_um - step_um), law)) /
                               step_um;
    EXPECT_NEAR(from_inside, slope, 1e-7 * std::abs(slope));
}

INSTANTIATE_TEST_SUITE_P(RejectCos, PairForce, testing::Values(0.0, 0.3),
                         [](const auto& tested) { return tested.param == 0.0 ? "0" : "0_3"; });

}  // namespace
}  // namespace spheroscope::test
