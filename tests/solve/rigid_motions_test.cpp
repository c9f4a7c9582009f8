// The motions of whole cells in the preconditioner of an implicit step, against dense matrices.
#include "engine/base/random.hpp"
#include "engine/forces/compaction_wall.hpp"
#include "engine/solve/conjugate_gradients.hpp"
#include "tests/reference/dense_system.hpp"
#include "tests/reference/made_up_cells.hpp"

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace spheroscope::test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Elements are stored, and lanes work, in single precision.
constexpr double k_single = 2e-5;

/// Four cells that touch, one of them with two others, inside a wall.
class RigidMotionsOfCells : public testing::Test {
  protected:
    static constexpr double dt_s = 10.0;
    static Cluster row() {
        Cluster cells{make_model(make_icosphere(42), {4.0, 5.0, 4.5, 4.2}), {}};
        const std::vector<Vec3> centres{Vec3(-8.7, 0, 0), Vec3(0, 0, 0), Vec3(9.1, 0, 0),
                                        Vec3(-0.2, 8.8, 0)};
        cells.x_um = turned_cells(cells.model, centres, 5, 0.05);
        return cells;
    }
    static PartValues values() {
        PartValues v = case_a_values();
        v.contact_friction = ContactFriction{0.07, 0.02};
        return v;
    }
    static SystemParts parts() {
        SystemParts parts = make_parts(values());
        auto wall = std::make_unique<CompactionWall>(Loc{}, CompactionWallParameters{2.0});
        parts.wall = wall.get();
        parts.terms.push_back(std::move(wall));
        return parts;
    }
    RigidMotionsOfCells() : system(cells.model, parts(), 2) {
        constexpr double wall_um = 12.6;  // the outer cells touch it
        EXPECT_FALSE(system.evaluate(cells.x_um, std::vector<double>(4, 0.0), wall_um));
        EXPECT_EQ(system.contacts().groups.size(), 3U);
    }
    /// nullptr if they are left out.
    const RigidMotions* motions_of_a_long_step() {
        preconditioner.prepare(system.velocity_system(dt_s, {}), system.workers());
        return preconditioner.rigid_motions();
    }
    Eigen::Index n_cells() const { return system.model().n_cells(); }
    Eigen::Index n_nodes() const { return system.model().n_nodes(); }

    /// Column 3 c + k: cell c moves along axis k, or turns about it through its middle.
    MatrixXd motions(bool turn) const {
        MatrixXd P = MatrixXd::Zero(3 * n_cells() * n_nodes(), 3 * n_cells());
        for (Eigen::Index c = 0; c < n_cells(); ++c) {
            const std::span<const Vec3> x =
                system.model().cell_nodes(std::span<const Vec3>(cells.x_um), static_cast<int>(c));
            Vec3 middle = Vec3::Zero();
            for (const Vec3& node : x) middle += node / static_cast<double>(x.size());
            for (Eigen::Index i = 0; i < n_nodes(); ++i)
                for (Eigen::Index k = 0; k < 3; ++k) {
                    const Vec3 axis = Vec3::Unit(k);
                    P.block<3, 1>(3 * (c * n_nodes() + i), 3 * c + k) =
                        turn ? Vec3(axis.cross(x[static_cast<std::size_t>(i)] - middle)) : axis;
                }
        }
        return P;
    }

    Cluster cells = row();
    System system;
    BlockJacobi preconditioner;
};

TEST_F(RigidMotionsOfCells, TranslationsAreThoseOfTheWholeMatrix) {
    const RigidMotions* const rigid = motions_of_a_long_step();
    ASSERT_NE(rigid, nullptr);
    const MatrixXd A = reference::dense_product(system.velocity_system(dt_s, {}), system.workers());
    const MatrixXd P = motions(false);
    const MatrixXd coarse = P.transpose() * A * P;
    const auto n = static_cast<std::size_t>(coarse.rows());
    for (Eigen::Index k = 0; k < coarse.rows(); ++k) {
        const VectorXd wanted = VectorXd::Unit(coarse.rows(), k);
        const VectorXd force = coarse * wanted;
        std::vector<double> velocity(n), work(n);
        rigid->translations(std::span(force.data(), n), velocity, work);
        for (Eigen::Index i = 0; i < coarse.rows(); ++i)
            EXPECT_NEAR(velocity[static_cast<std::size_t>(i)], wanted[i], k_single) << k;
    }
}

TEST_F(RigidMotionsOfCells, RotationsAreThoseOfACellAmongOthersThatStandStill) {
    const RigidMotions* const rigid = motions_of_a_long_step();
    ASSERT_NE(rigid, nullptr);
    const MatrixXd A = reference::dense_product(system.velocity_system(dt_s, {}), system.workers());
    const MatrixXd R = motions(true);
    for (Eigen::Index c = 0; c < n_cells(); ++c)
        for (Eigen::Index k = 0; k < 3; ++k) {
            // forces that would turn this cell alone about one axis ...
            const VectorXd turn = R.col(3 * c + k);
            const VectorXd force = A * turn;
            std::vector<Lanes> r, z(static_cast<std::size_t>(n_nodes()));
            for (Eigen::Index i = 0; i < n_nodes(); ++i)
                r.emplace_back(Vec3(force.segment<3>(3 * (c * n_nodes() + i))));
            const int cell = static_cast<int>(c);
            rigid->add_turning(cell, rigid->turning(cell, r), z);
            // ... do turn it like that
            for (Eigen::Index i = 0; i < n_nodes(); ++i)
                EXPECT_LE((z[static_cast<std::size_t>(i)].vec3() -
                           turn.segment<3>(3 * (c * n_nodes() + i)))
                              .norm(),
                          1e-3 * system.model().radius_um[static_cast<std::size_t>(c)])
                    << cell;
        }
}

TEST_F(RigidMotionsOfCells, AreLeftOutOfAShortStep) {
    preconditioner.prepare(system.velocity_system(1e-4, {}), system.workers());
    EXPECT_EQ(preconditioner.rigid_motions(), nullptr);
    EXPECT_NE(motions_of_a_long_step(), nullptr);
    preconditioner.prepare(system.velocity_system(1e-4, {}), system.workers());
    EXPECT_EQ(preconditioner.rigid_motions(), nullptr);
}

TEST_F(RigidMotionsOfCells, SpareHalfOfTheIterationsOfALongStep) {
    const std::vector<double> coefficient(4, 0.02);
    const VelocitySystem matrix = system.velocity_system(dt_s, coefficient);
    const Random random(3, 41);
    std::vector<Vec3> b;
    for (std::size_t i = 0; i < cells.x_um.size(); ++i)
        b.emplace_back(random.normal(i, 0), random.normal(i, 1), random.normal(i, 2));
    std::vector<SolveOutcome> outcome;
    std::vector<VectorXd> solution;
    for (const double stiff : {std::numeric_limits<double>::infinity(), BlockJacobi::k_stiff}) {
        BlockJacobi with(stiff);
        with.prepare(matrix, system.workers());
        EXPECT_EQ(with.rigid_motions() == nullptr, std::isinf(stiff));
        std::vector<Vec3> v(b.size(), Vec3::Zero());
        ConjugateGradients solver;
        outcome.push_back(solver.solve(matrix, with, b, v, 1e-8, 2000, system.workers()));
        EXPECT_TRUE(outcome.back().converged);
        solution.push_back(reference::flat(v));
    }
    EXPECT_LT(2 * outcome[1].iterations, outcome[0].iterations) << outcome[1].iterations;
    // what friction alone holds amplifies a residual a hundredfold
    EXPECT_LE((solution[0] - solution[1]).norm(), 1e-5 * solution[0].norm());
}

}  // namespace
}  // namespace spheroscope::test
