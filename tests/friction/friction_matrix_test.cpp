#include "engine/base/random.hpp"
#include "tests/reference/dense_system.hpp"
#include "tests/reference/made_up_cells.hpp"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <numeric>

namespace spheroscope::test {
namespace {

using Eigen::MatrixXd;
using reference::largest;

/// Two small cells of unequal size that overlap, with every friction; across and along the contact
/// differ, so that a swap of the two shows.
class FrictionMatrix : public testing::Test {
  protected:
    static constexpr ContactFriction contact_friction{0.07, 0.02};

    static PartValues values() {
        PartValues v;
        v.gamma_nN_per_um = 0.5;
        v.K_kPa = 5.0;
        v.T_I_s = 0.115;
        v.T_d_s = 1.15;
        v.eta_kPa_s = 1.0;
        v.contact = adhesive_law(0.5, 0.3, 2.0, 0.0);
        v.contact_friction = contact_friction;
        return v;
    }
    static Cluster doublet() { return make_doublet(42, 7, 4.0, 5.0, 0.3, 0.1); }

    FrictionMatrix() : system(cells.model, make_parts(values()), 1) {
        const std::vector<double> integral(2, 0.0);
        EXPECT_FALSE(system.evaluate(cells.x_um, integral, 0.0));
        EXPECT_GT(system.contacts().n_pairs(), 5U);
    }
    MatrixXd product() {
        return reference::dense_product(system.velocity_system(0.0, system.volume_friction()),
                                        system.workers());
    }

    Cluster cells = doublet();
    System system;
};

TEST_F(FrictionMatrix, IsTheSumOfItsDefinitions) {
    const MatrixXd gamma = product();
    const MatrixXd twin =
        reference::dense_drag(cells.model, 0.05) +
        reference::dense_cortex(cells.model, system.parts().frictions.edge_nN_s_per_um) +
        reference::dense_contact_friction(cells.model, system.contacts(), contact_friction) +
        reference::dense_volume(cells.model, system.volume_friction(),
                                system.geometry().volume_gradient_um2);
    // the elements of pairs are stored in single precision
    EXPECT_LE(largest(gamma - twin), 2e-7 * largest(twin));
}

TEST_F(FrictionMatrix, HasTheDerivativePartOfTheVolumeControllerAsAFriction) {
    ASSERT_EQ(system.volume_friction().size(), 2U);
    for (std::size_t c = 0; c < 2; ++c)
        EXPECT_NEAR(system.volume_friction()[c],
                    *values().K_kPa * values().T_d_s / cells.model.target_volume_um3[c], 1e-15);
}

TEST_F(FrictionMatrix, IsSymmetricAndPositiveDefinite) {
    const MatrixXd gamma = product();
    EXPECT_LE(largest(gamma - gamma.transpose()), 1e-12 * largest(gamma));
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(gamma, Eigen::EigenvaluesOnly);
    const double smallest_drag = reference::dense_drag(cells.model, 0.05).diagonal().minCoeff();
    // All other frictions are positive semi-definite, so the drag is a lower bound.
    EXPECT_GE(eigen.eigenvalues().minCoeff(), smallest_drag * (1.0 - 1e-12));
    EXPECT_GT(smallest_drag, 0.0);
}

TEST_F(FrictionMatrix, OfCortexAndContactsHasRowsThatSumToZero) {
    VelocitySystem gamma = system.velocity_system(0.0, {});
    const MatrixXd with_drag = reference::dense_product(gamma, system.workers());
    const MatrixXd inner = with_drag - reference::dense_drag(cells.model, 0.05);
    for (Eigen::Index k = 0; k < 3; ++k) {
        Eigen::VectorXd uniform = Eigen::VectorXd::Zero(inner.cols());
        for (Eigen::Index i = k; i < inner.cols(); i += 3) uniform[i] = 1.0;
        EXPECT_LE((inner * uniform).cwiseAbs().maxCoeff(), 1e-12 * largest(with_drag));
        EXPECT_LE((uniform.transpose() * inner).cwiseAbs().maxCoeff(), 1e-12 * largest(with_drag));
    }
}

TEST_F(FrictionMatrix, ResistsACommonVelocityByDragAlone) {
    const Vec3 v_um_per_s(0.3, -1.1, 0.7);
    const std::vector<Vec3> v(cells.model.n_all_nodes(), v_um_per_s);
    std::vector<Vec3> out(v.size());
    system.velocity_system(0.0, system.volume_friction()).product(v, out, system.workers());
    const std::vector<double> drag = node_drags(cells.model, 0.05);
    for (std::size_t i = 0; i < v.size(); ++i)
        EXPECT_LE((out[i] - drag[i] * v_um_per_s).norm(), 1e-12) << "node " << i;
}

TEST_F(FrictionMatrix, DissipatesContactFrictionByTheRelativeVelocityOfTheCells) {
    // Cells as wholes at +-v: every pair of triangles resists with S g |2 v|^2, weights summing to
    // one.
    VelocitySystem gamma = system.velocity_system(0.0, {});
    const Vec3 v_um_per_s(0.5, 0.2, -0.3);
    std::vector<Vec3> u(cells.model.n_all_nodes(), v_um_per_s), out(u.size());
    for (Vec3& node : cells.model.cell_nodes(std::span<Vec3>(u), 1)) node = -v_um_per_s;
    gamma.product(u, out, system.workers());
    const std::vector<double> drag = node_drags(cells.model, 0.05);
    double power = 0.0, expected = 0.0;
    for (std::size_t i = 0; i < u.size(); ++i) power += u[i].dot(out[i] - drag[i] * u[i]);
    for (const ContactPair& pair : system.contacts().groups.at(0).pairs) {
        const Vec3 relative = 2.0 * v_um_per_s;
        const double across = pair.normal.dot(relative);
        expected += pair.area_um2 * (contact_friction.normal_kPa_s_per_um * across * across +
                                     contact_friction.tangential_kPa_s_per_um *
                                         (relative.squaredNorm() - across * across));
    }
    EXPECT_NEAR(power, expected, 1e-7 * expected);
}

}  // namespace
}  // namespace spheroscope::test
