#include "engine/solve/probe_coupling.hpp"
#include "tests/reference/dense_system.hpp"
#include "tests/reference/made_up_cells.hpp"

#include <Eigen/LU>
#include <gtest/gtest.h>

namespace spheroscope::test {
namespace {

/// A doublet in a hull of two planes, under a probe that is `overlap_um` in it.
class LoadedDoublet : public testing::Test {
  protected:
    LoadedDoublet()
        : system_(cells_.model, parts(), 1), state_(state_at(cells_.model, cells_.x_um)) {
        double top_um = -1e9, bottom_um = 1e9;
        for (const Vec3& x : state_.x_um) {
            top_um = std::max(top_um, x.z());
            bottom_um = std::min(bottom_um, x.z());
        }
        Hull hull;
        hull.planes = {{-Vec3::UnitZ(), -(bottom_um + 0.2)},
                       {Vec3(0.3, 0.2, -1.0).normalized(), 16.0}};
        state_.load.hull = std::make_shared<const Hull>(std::move(hull));
        state_.load.probe = {.radius_um = 27.0,
                             .force_nN = 15.0,
                             .friction_nN_s_per_um = 25.4,
                             .start_um = Vec3(1.0, -0.5, top_um + 27.0),
                             .direction = Vec3(0.05, 0.0, -1.0).normalized(),
                             .way_um = 3.0};
    }
    static SystemParts parts() {
        SystemParts parts = make_parts(case_a_values());
        auto hull = std::make_unique<ConfiningHull>(Loc{}, ConfiningHullParameters{27.8});
        auto probe = std::make_unique<IndentingProbe>(Loc{}, IndentingProbeParameters{27.8});
        parts.hull = hull.get();
        parts.probe = probe.get();
        parts.terms.push_back(std::move(hull));
        parts.terms.push_back(std::move(probe));
        return parts;
    }
    Cluster cells_ = make_doublet(42, 3, 9.0, 8.2, 0.4, 0.05);
    System system_;
    State state_;
};

TEST_F(LoadedDoublet, IsSolvedLikeADenseSystemWithOneMoreUnknown) {
    for (const double dt_s : {1e-3, 0.1, 10.0}) {
        SCOPED_TRACE(dt_s);
        ASSERT_FALSE(system_.evaluate(state_.x_um, state_.volume_integral_s, 0.0, state_.load));
        const std::vector<double> coefficient(2, 0.02);
        const std::vector<Vec3> b(system_.force_nN().begin(), system_.force_nN().end());

        std::vector<IndentingProbe::Touch> touches;
        system_.parts().probe->find_touches(system_.configuration(), touches);
        ASSERT_GT(touches.size(), 2U);
        const auto n = static_cast<Eigen::Index>(3 * b.size());
        Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n + 1, n + 1);
        dense.topLeftCorner(n, n) =
            reference::dense_product(system_.velocity_system(dt_s, coefficient), system_.workers());
        Eigen::VectorXd right(n + 1);
        right.head(n) = reference::flat(b);
        dense(n, n) = state_.load.probe.friction_nN_s_per_um;
        right[n] = state_.load.probe.force_nN;
        for (const auto& touch : touches) {
            const auto row = static_cast<Eigen::Index>(3 * touch.node);
            const Vec3 g = dt_s * touch.k_nN_per_um * touch.along * touch.outward;
            dense.block<3, 1>(row, n) = -g;
            dense.block<1, 3>(n, row) = -g.transpose();
            dense(n, n) += dt_s * touch.k_nN_per_um * touch.along * touch.along;
            right[n] -= touch.force_nN * touch.along;
        }
        const Eigen::VectorXd expected = dense.fullPivLu().solve(right);

        ProbeCoupling coupling;
        std::vector<Vec3> v(b.size(), Vec3::Zero());
        const SolveOutcome outcome =
            coupling.solve(system_, state_, dt_s, coefficient, b, v, 1e-10);
        ASSERT_TRUE(outcome.converged);
        // single precision of the elements, times what the long step amplifies
        EXPECT_NEAR(coupling.speed_um_per_s(), expected[n], 1e-3 * std::abs(expected[n]));
        EXPECT_LT((reference::flat(v) - expected.head(n)).norm(), 1e-3 * expected.head(n).norm());
        // A tolerance of 1e-3 costs digits of this speed, the more the longer the step: 6e-5, 0.035
        // and 0.30 of it. Scenes with a probe want 1e-4.
        std::vector<Vec3> rough(b.size(), Vec3::Zero());
        ASSERT_TRUE(coupling.solve(system_, state_, dt_s, coefficient, b, rough, 1e-3).converged);
        const double allowed = dt_s < 0.01 ? 1e-3 : dt_s < 1.0 ? 0.1 : 0.5;
        EXPECT_NEAR(coupling.speed_um_per_s(), expected[n], allowed * std::abs(expected[n]));
        ASSERT_TRUE(coupling.solve(system_, state_, dt_s, coefficient, b, rough, 1e-5).converged);
        EXPECT_NEAR(coupling.speed_um_per_s(), expected[n], 0.02 * std::abs(expected[n]));
    }
}

TEST_F(LoadedDoublet, ProbeInTheOpenMovesAgainstItsOwnFrictionAlone) {
    state_.load.probe.way_um = -1.0;
    ASSERT_FALSE(system_.evaluate(state_.x_um, state_.volume_integral_s, 0.0, state_.load));
    const std::vector<Vec3> b(system_.force_nN().begin(), system_.force_nN().end());
    ProbeCoupling coupling;
    std::vector<Vec3> v(b.size(), Vec3::Zero()), alone(b.size(), Vec3::Zero());
    const SolveOutcome outcome = coupling.solve(system_, state_, 0.1, {}, b, v, 1e-6);
    const SolveOutcome without = system_.solve_implicit(0.1, {}, b, alone, 1e-6);
    EXPECT_EQ(coupling.speed_um_per_s(), 15.0 / 25.4);
    EXPECT_EQ(outcome.iterations, without.iterations);
    EXPECT_EQ(v, alone);
    coupling.finish_step(state_, 0.1);
    EXPECT_NEAR(state_.load.probe.way_um, -1.0 + 1.5 / 25.4, 1e-14);
}

TEST_F(LoadedDoublet, WithoutLoadCostsNothing) {
    state_.load = {};
    ASSERT_FALSE(system_.evaluate(state_.x_um, state_.volume_integral_s, 0.0, state_.load));
    EXPECT_EQ(system_.work().evaluations("stage.indent.hull"), 0);
    EXPECT_EQ(system_.work().evaluations("stage.indent.probe"), 0);
    const std::vector<Vec3> b(system_.force_nN().begin(), system_.force_nN().end());
    ProbeCoupling coupling;
    std::vector<Vec3> v(b.size(), Vec3::Zero());
    ASSERT_TRUE(coupling.solve(system_, state_, 0.1, {}, b, v, 1e-3).converged);
    EXPECT_EQ(system_.work().linear_solves, 1);
    EXPECT_EQ(coupling.speed_um_per_s(), 0.0);
}

}  // namespace
}  // namespace spheroscope::test
