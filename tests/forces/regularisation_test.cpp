#include "engine/forces/cell_stiffness.hpp"
#include "engine/forces/fold_stop.hpp"
#include "engine/forces/strain_limiter.hpp"
#include "tests/forces/test_cell.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace spheroscope::test {
namespace {

const StrainLimiter k_limiter({}, StrainLimiterParameters{0.25, 0.1});

void scale(TestCell& test, double factor) {
    for (Vec3& x : test.x()) x *= factor;
    test.update();
}

// psi = (s^2 + s^-2)/2 - 1 for a uniform stretch s: 0.1 at s = 1.2483 and at 1/1.2483 = 0.8011.
TEST(StrainLimiter, IsExactlySilentWithinItsRangeOfUniformStrain) {
    for (const double R : {5.0, 13.0})
        for (const double factor : {0.802, 1.0, 1.248}) {
            TestCell test(162, R);
            scale(test, factor);
            EXPECT_EQ(norm(test.force_nN(k_limiter)), 0.0);
            EXPECT_EQ(test.energy_fJ(k_limiter), 0.0);
            CellStiffness K;
            k_limiter.add_stiffness(test.at(), TestCell::cell, K);
            EXPECT_TRUE(K.edges.empty() && K.triangles.empty());
        }
}

TEST(StrainLimiter, PushesBackJustOutsideItsRange) {
    for (const double factor : {0.800, 1.249}) {
        TestCell test(162);
        scale(test, factor);
        const std::vector<Vec3> F = test.force_nN(k_limiter);
        for (std::size_t i = 0; i < F.size(); ++i)
            EXPECT_GT(F[i].dot(test.x()[i]) * (1.0 - factor), 0.0);
    }
}

TEST(StrainLimiter, EnergyOfUniformStretchIsItsClosedForm) {
    const double kappa = 0.25, psi0 = 0.1, factor = 1.5;
    TestCell test(162);
    scale(test, factor);
    const double y = 0.5 * (factor * factor + 1.0 / (factor * factor)) - 1.0 - psi0;
    const double expected = kappa * 81.0 * test.model.unit_area * y * y / (y + psi0);
    EXPECT_NEAR(test.energy_fJ(k_limiter), expected, 1e-12 * expected);
}

// For a uniform stretch s of an acute mesh, along dx/ds. The second derivative of the energy
// itself, g'' psi'^2 + g' (1 + 3 s^-4) per area, is never above it.
TEST(StrainLimiter, StiffnessOfUniformStretchIsTheClosedFormOfItsPositiveParts) {
    const double kappa = 0.25, psi0 = 0.1;
    for (const double s : {0.7, 1.5}) {
        TestCell test(162);
        const std::vector<Vec3> u(test.x().begin(), test.x().end());
        scale(test, s);
        CellStiffness K;
        k_limiter.add_stiffness(test.at(), TestCell::cell, K);
        std::vector<Vec3> Ku(u.size(), Vec3::Zero());
        K.add_product(1.0, u, Ku);
        double quadratic = 0.0;
        for (std::size_t i = 0; i < u.size(); ++i) quadratic += u[i].dot(Ku[i]);
        const double psi_slope = s - std::pow(s, -3);
        const double y = 0.5 * (s * s + 1.0 / (s * s)) - 1.0 - psi0;
        const double first = 1.0 - psi0 * psi0 / ((y + psi0) * (y + psi0));
        const double second = 2.0 * psi0 * psi0 / std::pow(y + psi0, 3);
        const double per_area = second * psi_slope * psi_slope + first * (1.0 + std::pow(s, -4)) +
                                first * 12.0 * std::pow(s, -4);
        const double expected = kappa * 81.0 * test.model.unit_area * per_area;
        EXPECT_NEAR(quadratic, expected, 2e-7 * expected);  // elements in single precision
    }
}

// A node moves on to the opposite side of one triangle: its height h is the ratio of areas J up to
// a factor, and the energy of that triangle leaves all others behind.
TEST(StrainLimiter, EnergyOfACollapsingTriangleGrowsWithTheInverseSquareOfItsArea) {
    TestCell test(42);
    const auto& [i, j, k] = test.model.topology->triangles[0];
    const auto node = [&](int n) -> Vec3& { return test.x()[static_cast<std::size_t>(n)]; };
    const Vec3 foot = 0.5 * (node(j) + node(k));
    const Vec3 up = (node(i) - foot).normalized();
    const auto energy_at = [&, apex = i](double h_um) {
        node(apex) = foot + h_um * up;
        return test.energy_fJ(k_limiter);
    };
    const double tall = energy_at(1e-3), low = energy_at(1e-4), lower = energy_at(1e-5);
    EXPECT_NEAR(low / tall, 100.0, 0.1);
    EXPECT_NEAR(lower / low, 100.0, 0.1);
}

TEST(FoldStop, IsExactlySilentBelowTheFoldAngleAndActsAboveIt) {
    const double fold_angle = std::numbers::pi / 3.0;
    const FoldStop stop({}, FoldStopParameters{0.25, fold_angle});
    TestCell test(162);
    const Vec3 start = test.x()[20];
    int n_silent = 0, n_acting = 0;
    for (double push = 0.0; push < 0.9; push += 0.03) {  // one node moves into the cell
        test.x()[20] = (1.0 - push) * start;
        double largest_turn = 0.0;
        for (std::size_t n = 0; n < test.model.topology->edges.size(); ++n) {
            const MeshTopology::Edge& e = test.model.topology->edges[n];
            const auto x = [&](int node) { return test.x()[static_cast<std::size_t>(node)]; };
            largest_turn =
                std::max(largest_turn, std::abs(hinge_angle(x(e.i), x(e.j), x(e.a), x(e.b)) -
                                                test.model.rest_hinge_angle_rad[n]));
        }
        if (largest_turn < fold_angle) {
            ++n_silent;
            EXPECT_EQ(test.energy_fJ(stop), 0.0);
            EXPECT_EQ(norm(test.force_nN(stop)), 0.0);
        } else {
            ++n_acting;
            EXPECT_GT(test.energy_fJ(stop), 0.0);
            EXPECT_GT(test.force_nN(stop)[20].dot(start), 0.0) << "must push the node back out";
        }
    }
    EXPECT_GT(n_silent, 3);
    EXPECT_GT(n_acting, 3);
}

// theta jumps by 2 pi where two triangles lie on each other; the energy must not, whether the rest
// shape is convex or concave there.
TEST(FoldStop, EnergyIsContinuousThroughACompleteFold) {
    const FoldStop stop({}, FoldStopParameters{0.25, std::numbers::pi / 2.0});
    for (const double rest_rad : {-0.3, 0.3}) {
        TestCell test(42);
        test.model.rest_hinge_angle_rad[0] = rest_rad;
        const MeshTopology::Edge e = test.model.topology->edges[0];
        const auto node = [&](int n) -> Vec3& { return test.x()[static_cast<std::size_t>(n)]; };
        const auto theta = [&] { return hinge_angle(node(e.i), node(e.j), node(e.a), node(e.b)); };
        const Vec3 i = node(e.i), axis = (node(e.j) - i).normalized(), from_i = node(e.b) - i;
        const auto turn_b = [&](double angle) {  // about the edge
            node(e.b) = i + Eigen::AngleAxisd(angle, axis) * from_i;
        };
        const double start = theta();
        turn_b(0.1);
        const double sense = theta() > start ? 1.0 : -1.0;
        const auto fold_to = [&](double wanted) { turn_b(sense * (wanted - start)); };
        fold_to(std::numbers::pi - 1e-6);
        const double theta_before = theta(), before = test.energy_fJ(stop);
        fold_to(std::numbers::pi + 1e-6);
        ASSERT_NEAR(theta_before - theta(), 2.0 * std::numbers::pi, 1e-5);
        EXPECT_NEAR(test.energy_fJ(stop), before, 1e-4 * before);
    }
}

}  // namespace
}  // namespace spheroscope::test
