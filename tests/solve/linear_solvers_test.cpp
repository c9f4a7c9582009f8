#include "engine/base/random.hpp"
#include "engine/solve/conjugate_gradients.hpp"
#include "engine/solve/cortex_factor.hpp"
#include "tests/reference/dense_system.hpp"
#include "tests/reference/made_up_cells.hpp"

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

namespace spheroscope::test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

std::vector<Vec3> random_vectors(std::size_t n, std::uint64_t seed) {
    const Random random(seed, 41);
    std::vector<Vec3> vectors;
    for (std::size_t i = 0; i < n; ++i)
        vectors.emplace_back(random.normal(i, 0), random.normal(i, 1), random.normal(i, 2));
    return vectors;
}

TEST(CortexFactor, SolvesLikeDenseCholesky) {
    for (const int n_nodes : {42, 162}) {
        const auto mesh = make_icosphere(n_nodes);
        const Random random(6, 42);
        std::vector<double> drag;
        for (int i = 0; i < n_nodes; ++i)
            drag.push_back(0.01 + 0.02 * random.uniform(static_cast<std::uint64_t>(i)));
        constexpr double edge_nN_s_per_um = 0.1155;
        MatrixXd matrix = MatrixXd::Zero(n_nodes, n_nodes);
        for (int i = 0; i < n_nodes; ++i) matrix(i, i) = drag[static_cast<std::size_t>(i)];
        for (const MeshTopology::Edge& e : mesh->edges) {
            matrix(e.i, e.i) += edge_nN_s_per_um;
            matrix(e.j, e.j) += edge_nN_s_per_um;
            matrix(e.i, e.j) -= edge_nN_s_per_um;
            matrix(e.j, e.i) -= edge_nN_s_per_um;
        }
        const CortexFactor factor(*mesh, drag, edge_nN_s_per_um);
        std::vector<Vec3> b = random_vectors(drag.size(), 1), x(b.size()), work(b.size());
        factor.solve<Vec3>(b, x, work);
        const Eigen::LLT<MatrixXd> dense(matrix);
        for (Eigen::Index k = 0; k < 3; ++k) {
            VectorXd right(n_nodes), solution(n_nodes);
            for (int i = 0; i < n_nodes; ++i) {
                right[i] = b[static_cast<std::size_t>(i)][k];
                solution[i] = x[static_cast<std::size_t>(i)][k];
            }
            // A condition number of some hundreds leaves 13 digits.
            EXPECT_LE((solution - dense.solve(right)).norm(), 1e-12 * solution.norm());
        }
        factor.solve<Vec3>(b, b, work);
        for (std::size_t i = 0; i < b.size(); ++i) EXPECT_EQ(b[i], x[i]) << "in place";
    }
}

TEST(SparseCholesky, SumsElementsAndSaysWhenAMatrixIsNotDefinite) {
    SparseCholesky cholesky;
    // [[2 -1 0] [-1 3 1] [0 1 2]], its 3 in two parts
    const std::vector<SparseCholesky::Entry> entries{{0, 0, 2.0}, {1, 0, -1.0}, {1, 1, 1.0},
                                                     {2, 1, 1.0}, {2, 2, 2.0},  {1, 1, 2.0}};
    ASSERT_TRUE(cholesky.factor(3, entries));
    std::vector<double> x{1.0, 9.0, 8.0}, work(3);
    cholesky.solve<double>(x, x, work);
    EXPECT_NEAR(2.0 * x[0] - x[1], 1.0, 1e-14);
    EXPECT_NEAR(-x[0] + 3.0 * x[1] + x[2], 9.0, 1e-14);
    EXPECT_NEAR(x[1] + 2.0 * x[2], 8.0, 1e-14);
    const std::vector<SparseCholesky::Entry> indefinite{{0, 0, 1.0}, {1, 0, 2.0}, {1, 1, 1.0}};
    EXPECT_FALSE(cholesky.factor(2, indefinite));
}

/// Three cells in a row that touch, with every friction.
class CoupledCells : public testing::Test {
  protected:
    static Cluster row() {
        Cluster cells{make_model(make_icosphere(42), {4.0, 5.0, 4.5}), {}};
        const std::vector<Vec3> centres{Vec3(0, 0, 0), Vec3(8.7, 0, 0), Vec3(17.8, 0, 0)};
        cells.x_um = turned_cells(cells.model, centres, 5, 0.05);
        return cells;
    }
    static PartValues values() {
        PartValues v = case_a_values();
        v.T_I_s = 0.115;
        v.T_d_s = 1.15;
        return v;
    }
    CoupledCells() : system(cells.model, make_parts(values()), 2) {
        EXPECT_FALSE(system.evaluate(cells.x_um, std::vector<double>(3, 0.0), 0.0));
        EXPECT_EQ(system.contacts().groups.size(), 2U);
    }
    Cluster cells = row();
    System system;
};

TEST_F(CoupledCells, FrictionIsSolvedLikeADenseSystem) {
    const VelocitySystem gamma = system.velocity_system(0.0, system.volume_friction());
    const MatrixXd dense = reference::dense_product(gamma, system.workers());
    const std::vector<Vec3> b = random_vectors(cells.x_um.size(), 2);
    std::vector<Vec3> v(b.size(), Vec3::Zero());
    const SolveOutcome outcome = system.solve_friction(b, v, 1e-13);
    ASSERT_TRUE(outcome.converged);
    EXPECT_GT(outcome.iterations, 0);
    const VectorXd expected = Eigen::LLT<MatrixXd>(dense).solve(reference::flat(b));
    EXPECT_LE((reference::flat(v) - expected).norm(), 1e-10 * expected.norm());
}

TEST_F(CoupledCells, ConjugateGradientsStopAtTheirTolerance) {
    const double dt_s = 0.01;
    const std::vector<double> coefficient(3, 0.02);
    const VelocitySystem matrix = system.velocity_system(dt_s, coefficient);
    const std::vector<Vec3> b = random_vectors(cells.x_um.size(), 3);
    int last_iterations = 0;
    for (const double tolerance : {1e-2, 1e-5, 1e-9}) {
        std::vector<Vec3> v(b.size(), Vec3::Zero()), product(b.size());
        const SolveOutcome outcome = system.solve_implicit(dt_s, coefficient, b, v, tolerance);
        ASSERT_TRUE(outcome.converged);
        matrix.product(v, product, system.workers());
        const double residual =
            (reference::flat(b) - reference::flat(product)).norm() / reference::flat(b).norm();
        // The last pass knows its residual as well as single precision does.
        EXPECT_LE(residual, tolerance * (1.0 + 1e-4));
        EXPECT_NEAR(outcome.relative_residual, residual, 1e-6 * residual + 1e-5 * tolerance);
        EXPECT_GT(outcome.iterations, last_iterations);
        last_iterations = outcome.iterations;
    }
}

TEST_F(CoupledCells, ConjugateGradientsTakeNoStepFromASolutionAndSayWhenTheyFail) {
    const double dt_s = 0.01;
    const std::vector<double> coefficient(3, 0.02);
    const std::vector<Vec3> b = random_vectors(cells.x_um.size(), 4);
    std::vector<Vec3> v(b.size(), Vec3::Zero());
    ASSERT_TRUE(system.solve_implicit(dt_s, coefficient, b, v, 1e-12).converged);
    EXPECT_EQ(system.solve_implicit(dt_s, coefficient, b, v, 1e-9).iterations, 0);

    const VelocitySystem matrix = system.velocity_system(dt_s, coefficient);
    BlockJacobi preconditioner;
    preconditioner.prepare(matrix, system.workers());
    ConjugateGradients solver;
    std::fill(v.begin(), v.end(), Vec3::Zero());
    const SolveOutcome outcome =
        solver.solve(matrix, preconditioner, b, v, 1e-12, 3, system.workers());
    EXPECT_FALSE(outcome.converged);
    EXPECT_EQ(outcome.iterations, 3);
    EXPECT_GT(outcome.relative_residual, 1e-12);

    std::vector<Vec3> bad = b;
    bad[7].y() = std::numeric_limits<double>::quiet_NaN();
    std::fill(v.begin(), v.end(), Vec3::Zero());
    EXPECT_FALSE(
        solver.solve(matrix, preconditioner, bad, v, 1e-12, 100, system.workers()).converged);
}

TEST(VolumePart, IsInvertedExactlyWhereNoCellsTouch) {
    // Sherman and Morrison: drag and cortex alone are solved directly, and so they are with the
    // rank-one part of the volume controller, which is a thousand times stiffer.
    for (const double eta_kPa_s : {0.0, 1.0}) {
        PartValues values;
        values.K_kPa = 5.0;
        values.T_I_s = 0.115;
        values.T_d_s = 1.15;
        values.eta_kPa_s = eta_kPa_s;
        const Model model = make_model(make_icosphere(42), {6.0, 5.0});
        const std::vector<Vec3> x =
            turned_cells(model, std::vector<Vec3>{Vec3::Zero(), Vec3(40, 0, 0)}, 8, 0.1);
        System system(model, make_parts(values), 1);
        ASSERT_FALSE(system.evaluate(x, std::vector<double>(2, 0.0), 0.0));
        const std::vector<Vec3> b = random_vectors(x.size(), 9);
        std::vector<Vec3> v(b.size(), Vec3::Zero());
        const SolveOutcome outcome = system.solve_friction(b, v, 1e-30);
        EXPECT_TRUE(outcome.converged);
        EXPECT_EQ(outcome.iterations, 0);
        const MatrixXd dense = reference::dense_product(
            system.velocity_system(0.0, system.volume_friction()), system.workers());
        const VectorXd expected = Eigen::LLT<MatrixXd>(dense).solve(reference::flat(b));
        EXPECT_LE((reference::flat(v) - expected).norm(), 1e-10 * expected.norm());
    }
}

}  // namespace
}  // namespace spheroscope::test
