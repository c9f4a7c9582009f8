// The matrix of an implicit step, and the step itself, against dense ones.
#include "tests/reference/dense_system.hpp"
#include "tests/reference/made_up_cells.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <cmath>

namespace spheroscope::test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using reference::largest;

/// What the elements of a matrix, stored in single precision, leave of an exact solution.
constexpr double k_single = 1e-7;

class ImplicitSystem : public testing::Test {
  protected:
    static constexpr double dt_s = 0.02;
    static PartValues values() {
        PartValues v = case_a_values();
        v.T_I_s = 0.115;
        v.T_d_s = 1.15;
        v.contact_friction = ContactFriction{0.07, 0.02};
        return v;
    }
    ImplicitSystem() : system(cells.model, make_parts(values()), 1) {
        EXPECT_FALSE(system.evaluate(cells.x_um, integral_s, 0.0));
    }
    static std::vector<CellStiffness> elements(const System& of) {
        std::vector<CellStiffness> K(of.model().radius_um.size());
        for (int cell = 0; cell < of.model().n_cells(); ++cell)
            for (const auto& term : of.parts().terms)
                term->add_stiffness(of.configuration(), cell, K[static_cast<std::size_t>(cell)]);
        return K;
    }
    /// Gamma + dt K + coefficient S S^T from the definitions.
    MatrixXd dense(std::span<const double> coefficient) {
        const Frictions& frictions = system.parts().frictions;
        return reference::dense_drag(cells.model, frictions.eta_f_kPa_s) +
               reference::dense_cortex(cells.model, frictions.edge_nN_s_per_um) +
               reference::dense_contact_friction(cells.model, system.contacts(),
                                                 *frictions.contact) +
               dt_s * reference::dense_cell_stiffness(cells.model, elements(system)) +
               dt_s * reference::dense_contact_stiffness(cells.model, system.contacts(),
                                                         system.parts().contact->k_kPa_per_um) +
               reference::dense_volume(cells.model, coefficient,
                                       system.geometry().volume_gradient_um2);
    }

    Cluster cells = make_doublet(42, 7, 4.0, 5.0, 0.3, 0.1);
    std::vector<double> integral_s{1e-3, -2e-3};
    System system;
};

TEST_F(ImplicitSystem, IsFrictionPlusTimeStepTimesStiffness) {
    const std::vector<double> coefficient{0.03, 0.05};
    const MatrixXd matrix =
        reference::dense_product(system.velocity_system(dt_s, coefficient), system.workers());
    const MatrixXd twin = dense(coefficient);
    // the elements of pairs and cells are stored in single precision
    EXPECT_LE(largest(matrix - twin), 2e-7 * largest(twin));
    // and so are the sums that make up the diagonal blocks
    EXPECT_LE(largest(matrix - matrix.transpose()), 2e-8 * largest(twin));
}

TEST_F(ImplicitSystem, HasAContactStiffnessThatIsSymmetricAndPositiveSemiDefinite) {
    PartValues contact_alone;
    contact_alone.contact = values().contact;
    contact_alone.contact_friction = values().contact_friction;
    System contacts(cells.model, make_parts(contact_alone), 1);
    ASSERT_FALSE(contacts.evaluate(cells.x_um, integral_s, 0.0));
    const auto dense = [&](double dt) {
        return reference::dense_product(contacts.velocity_system(dt, {}), contacts.workers());
    };
    const MatrixXd K = dense(1.0) - dense(0.0);
    ASSERT_GT(largest(K), 0.0);
    EXPECT_LE(largest(K - K.transpose()), 1e-13 * largest(K));
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(K, Eigen::EigenvaluesOnly);
    // sums of squares, each block rounded to single precision
    EXPECT_GE(eigen.eigenvalues().minCoeff(), -1e-7 * largest(K));
}

TEST_F(ImplicitSystem, HasTheDiagonalBlocksOfItsProduct) {
    const VelocitySystem matrix = system.velocity_system(dt_s, {});
    const MatrixXd whole = reference::dense_product(matrix, system.workers());
    for (int cell = 0; cell < 2; ++cell) {
        const std::span<const double> drag = cells.model.cell_nodes(matrix.drag_nN_s_per_um, cell);
        std::vector<Mat3> blocks;
        for (const double d : drag) blocks.emplace_back(d * Mat3::Identity());
        matrix.cells->add_diagonal(cell, blocks);
        matrix.pairs.add_diagonal(cell, matrix.contacts, blocks);
        for (std::size_t i = 0; i < blocks.size(); ++i) {
            const auto row = static_cast<Eigen::Index>(
                3 * (static_cast<std::size_t>(cell * cells.model.n_nodes()) + i));
            EXPECT_LE(largest(blocks[i] - whole.block<3, 3>(row, row)), 1e-12 * largest(whole));
        }
    }
}

TEST_F(ImplicitSystem, InSinglePrecisionIsTheSameProduct) {
    const VelocitySystem matrix = system.velocity_system(dt_s, {});
    const std::size_t n = cells.x_um.size();
    std::vector<Vec3> u(n), out(n);
    std::vector<Lanes> u_single, out_single(n);
    for (std::size_t i = 0; i < n; ++i) {
        const auto x = static_cast<double>(i);
        u_single.emplace_back(Vec3(std::sin(x), std::cos(3.0 * x), std::sin(5.0 * x)));
        u[i] = u_single.back().vec3();
    }
    matrix.product(u, out, system.workers());
    for (int g = 0; g < matrix.n_groups(); ++g)
        matrix.product_of_group(g, std::span<const Lanes>(u_single));
    for (int team = 0; team < matrix.teams().n_teams(); ++team)
        matrix.product_of_team(team, std::span<const Lanes>(u_single),
                               std::span<Lanes>(out_single));
    double largest_of_all = 0.0;
    for (const Vec3& y : out) largest_of_all = std::max(largest_of_all, y.norm());
    for (std::size_t i = 0; i < n; ++i) {
        EXPECT_LE((out_single[i].vec3() - out[i]).norm(), 2e-6 * largest_of_all);
        EXPECT_EQ(out_single[i].lane[3], 0.0F) << "dot products rely on it";
    }
}

TEST_F(ImplicitSystem, OfAStepIsSolvedAndAppliedAsWritten) {
    const CytosolPressure& cytosol = *system.parts().cytosol;
    const Model& model = cells.model;
    // P at the end of the step: K eps, K/T_I I and K T_d eps' with eps and I of the end.
    std::vector<double> coefficient;
    std::vector<Vec3> b(system.force_nN().begin(), system.force_nN().end());
    std::vector<double> strain;
    for (int cell = 0; cell < 2; ++cell) {
        const auto c = static_cast<std::size_t>(cell);
        strain.push_back(cytosol.volume_strain(system.configuration(), cell));
        coefficient.push_back((cytosol.K_kPa() * dt_s +
                               cytosol.K_kPa() / cytosol.T_I_s() * dt_s * dt_s +
                               cytosol.K_kPa() * cytosol.T_d_s()) /
                              model.target_volume_um3[c]);
        for (std::size_t i = 0; i < 42; ++i)
            b[42 * c + i] -= cytosol.K_kPa() / cytosol.T_I_s() * dt_s * strain[c] *
                             system.geometry().volume_gradient_um2[42 * c + i];
    }
    const VectorXd v = Eigen::LLT<MatrixXd>(dense(coefficient)).solve(reference::flat(b));

    MethodParameters parameters;
    parameters.dt_s = dt_s;
    parameters.linear_tolerance = 1e-13;
    const auto method = find_method("linearly_implicit")->make(parameters);
    State state = state_at(model, cells.x_um);
    state.volume_integral_s = integral_s;
    const StepOutcome outcome = method->advance(system, state, 1e9, false);
    ASSERT_TRUE(outcome.accepted);
    EXPECT_EQ(outcome.dt_s, dt_s);
    EXPECT_EQ(state.time_s, dt_s);
    const VectorXd moved = reference::flat(state.x_um) - reference::flat(cells.x_um);
    EXPECT_LE((moved - dt_s * v).norm(), k_single * dt_s * v.norm());
    EXPECT_LE((reference::flat(state.v_um_per_s) - v).norm(), k_single * v.norm());
    const Geometry before = geometry_of(model, cells.x_um, Need::volumes);
    for (std::size_t c = 0; c < 2; ++c) {
        double volume_rate = 0.0;
        for (std::size_t i = 42 * c; i < 42 * (c + 1); ++i)
            volume_rate +=
                before.volume_gradient_um2[i].dot(v.segment<3>(static_cast<Eigen::Index>(3 * i)));
        const double end_strain = strain[c] + dt_s * volume_rate / model.target_volume_um3[c];
        EXPECT_NEAR(state.volume_integral_s[c], integral_s[c] + dt_s * end_strain, 1e-12);
    }
}

TEST_F(ImplicitSystem, OfAnExplicitStepIsTheFrictionMatrixAlone) {
    const MatrixXd gamma =
        reference::dense_drag(cells.model, 0.05) +
        reference::dense_cortex(cells.model, system.parts().frictions.edge_nN_s_per_um) +
        reference::dense_contact_friction(cells.model, system.contacts(),
                                          *system.parts().frictions.contact) +
        reference::dense_volume(cells.model, system.volume_friction(),
                                system.geometry().volume_gradient_um2);
    const VectorXd v = Eigen::LLT<MatrixXd>(gamma).solve(reference::flat(system.force_nN()));
    std::vector<double> strain;
    for (int cell = 0; cell < 2; ++cell)
        strain.push_back(system.parts().cytosol->volume_strain(system.configuration(), cell));

    MethodParameters parameters;
    parameters.dt_s = 1e-4;
    parameters.linear_tolerance = 1e-13;
    const auto method = find_method("forward_euler")->make(parameters);
    State state = state_at(cells.model, cells.x_um);
    state.volume_integral_s = integral_s;
    const StepOutcome outcome = method->advance(system, state, 1e9, false);
    ASSERT_TRUE(outcome.accepted) << outcome.trouble->text();
    const VectorXd moved = reference::flat(state.x_um) - reference::flat(cells.x_um);
    EXPECT_LE((moved - 1e-4 * v).norm(), k_single * 1e-4 * v.norm());
    for (std::size_t c = 0; c < 2; ++c)
        EXPECT_NEAR(state.volume_integral_s[c], integral_s[c] + 1e-4 * strain[c], 1e-15);
    EXPECT_NEAR(outcome.dissipation_nN_um_per_s, v.dot(gamma * v), k_single * v.dot(gamma * v));
}

}  // namespace
}  // namespace spheroscope::test
