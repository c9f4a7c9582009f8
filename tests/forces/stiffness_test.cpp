#include "engine/forces/active_tension.hpp"
#include "engine/forces/cell_stiffness.hpp"
#include "engine/forces/terms.hpp"
#include "tests/forces/test_cell.hpp"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

namespace spheroscope::test {
namespace {

constexpr double k_noise = 0.12;

/// The matrix behind add_product: column by column.
Eigen::MatrixXd dense(const CellStiffness& K, std::size_t n_nodes, double factor) {
    const auto n = static_cast<Eigen::Index>(3 * n_nodes);
    Eigen::MatrixXd matrix(n, n);
    for (Eigen::Index column = 0; column < n; ++column) {
        std::vector<Vec3> u(n_nodes, Vec3::Zero()), out(n_nodes, Vec3::Zero());
        u[static_cast<std::size_t>(column / 3)][column % 3] = 1.0;
        K.add_product(factor, u, out);
        for (std::size_t i = 0; i < n_nodes; ++i)
            matrix.block<3, 1>(static_cast<Eigen::Index>(3 * i), column) = out[i];
    }
    return matrix;
}

CellStiffness stiffness_of(const ForceTerm& term, const TestCell& test) {
    CellStiffness K;
    term.add_stiffness(test.at(), TestCell::cell, K);
    return K;
}

/// -dF/dx by central differences.
Eigen::MatrixXd force_slope(const ForceTerm& term, TestCell& test, double h_um) {
    const auto n = static_cast<Eigen::Index>(3 * test.n_nodes());
    Eigen::MatrixXd matrix(n, n);
    for (Eigen::Index column = 0; column < n; ++column) {
        double& x = test.x()[static_cast<std::size_t>(column / 3)][column % 3];
        const double start = x;
        x = start + h_um;
        test.update();
        const std::vector<Vec3> above = test.force_nN(term);
        x = start - h_um;
        test.update();
        const std::vector<Vec3> below = test.force_nN(term);
        x = start;
        for (std::size_t i = 0; i < test.n_nodes(); ++i)
            matrix.block<3, 1>(static_cast<Eigen::Index>(3 * i), column) =
                (below[i] - above[i]) / (2.0 * h_um);
    }
    test.update();
    return matrix;
}

class Stiffness : public testing::TestWithParam<std::size_t> {
  protected:
    std::unique_ptr<ForceTerm> term = make_term(GetParam());
};

TEST_P(Stiffness, IsSymmetricAndPositiveSemiDefinite) {
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
        TestCell test(42);
        test.shake(seed, k_noise);
        const Eigen::MatrixXd K = dense(stiffness_of(*term, test), test.n_nodes(), 1.0);
        const double size = K.cwiseAbs().maxCoeff();
        EXPECT_LE((K - K.transpose()).cwiseAbs().maxCoeff(), 1e-14 * size);
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(K, Eigen::EigenvaluesOnly);
        EXPECT_GE(eigen.eigenvalues().minCoeff(), -1e-13 * size);
    }
}

INSTANTIATE_TEST_SUITE_P(Terms, Stiffness, testing::Range(std::size_t{0}, force_terms().size()),
                         name_of_row);

TEST(StiffnessOfSprings, IsTheSlopeOfTheForceWhenNoSpringIsCompressed) {
    const std::unique_ptr<ForceTerm> springs = make_term(0);
    for (const double stretch : {1.0, 1.1}) {
        TestCell test(42);
        for (Vec3& x : test.x()) x *= stretch;
        const Eigen::MatrixXd K = dense(stiffness_of(*springs, test), test.n_nodes(), 1.0);
        const Eigen::MatrixXd slope = force_slope(*springs, test, 1e-4);
        EXPECT_LT((K - slope).norm(), 1e-7 * K.norm());
    }
}

TEST(StiffnessOfHinges, IsTheSlopeOfTheForceAtRest) {
    const std::unique_ptr<ForceTerm> hinges = make_term(1);
    TestCell test(42);
    const Eigen::MatrixXd K = dense(stiffness_of(*hinges, test), test.n_nodes(), 1.0);
    EXPECT_LT((K - force_slope(*hinges, test, 1e-4)).norm(), 1e-7 * K.norm());
}

TEST(StiffnessOfTheWall, IsTheSlopeOfTheForceAlongTheRadius) {
    const std::unique_ptr<ForceTerm> wall = make_term(6);
    TestCell test(42);
    test.shake(2, k_noise);
    const CellStiffness K = stiffness_of(*wall, test);
    ASSERT_FALSE(K.nodes.empty());
    for (const CellStiffness::Node& node : K.nodes) {
        const Vec3 radial = VectorTraits<Vec3>::from(node.direction).normalized();
        const auto i = static_cast<std::size_t>(node.node);
        const Vec3 start = test.x()[i];
        const double before = test.force_nN(*wall)[i].dot(radial);
        const double h_um = 1e-3;  // the law is linear along the radius
        test.x()[i] = start + h_um * radial;
        EXPECT_NEAR((before - test.force_nN(*wall)[i].dot(radial)) / h_um, double{node.coefficient},
                    1e-6 * double{node.coefficient});
        test.x()[i] = start;
    }
}

// The element of one triangle against the second difference of its area when its corners move along
// its normal; the next order of A is (w/side)^4.
TEST(StiffnessOfTension, IsTheSecondVariationOfAreaAlongTheNormal) {
    const double gamma = 0.5;
    const ActiveTension tension({}, ActiveTensionParameters{gamma});
    TestCell test(42);
    test.shake(4, k_noise);
    const CellStiffness K = stiffness_of(tension, test);
    for (std::size_t t = 0; t < K.normals.size(); ++t) {
        CellStiffness one;
        one.normals.push_back(K.normals[t]);
        const auto& nodes = one.normals[0].nodes;
        const std::array<double, 3> w = {0.01, -0.02, 0.015};
        std::vector<Vec3> u(test.n_nodes(), Vec3::Zero()), Ku(test.n_nodes(), Vec3::Zero());
        std::array<Vec3, 3> flat, raised;
        for (std::size_t c = 0; c < 3; ++c) {
            const auto i = static_cast<std::size_t>(nodes[c]);
            u[i] = w[c] * VectorTraits<Vec3>::from(one.normals[0].normal);
            flat[c] = test.x()[i];
            raised[c] = flat[c] + u[i];
        }
        one.add_product(1.0, u, Ku);
        double quadratic = 0.0;
        for (std::size_t i = 0; i < u.size(); ++i) quadratic += 0.5 * u[i].dot(Ku[i]);
        const auto area = [](const std::array<Vec3, 3>& x) {
            return 0.5 * (x[1] - x[0]).cross(x[2] - x[0]).norm();
        };
        const double growth = gamma * (area(raised) - area(flat));
        EXPECT_NEAR(growth, quadratic, 1e-3 * quadratic);
    }
}

TEST(StiffnessOfRegularisation, HasNoElementsWhereItIsSilent) {
    const TestCell test(162);
    for (const std::size_t row : {std::size_t{4}, std::size_t{5}}) {
        const CellStiffness K = stiffness_of(*make_term(row), test);
        EXPECT_TRUE(K.edges.empty() && K.triangles.empty() && K.hinges.empty());
    }
}

TEST(StiffnessLists, ClearLeavesNothing) {
    TestCell test(42);
    test.shake(1, k_noise);
    CellStiffness K;
    for (const auto& term : make_all_terms()) term->add_stiffness(test.at(), TestCell::cell, K);
    ASSERT_GT(dense(K, test.n_nodes(), 1.0).norm(), 0.0);
    K.clear();
    EXPECT_EQ(dense(K, test.n_nodes(), 1.0).norm(), 0.0);
}

}  // namespace
}  // namespace spheroscope::test
