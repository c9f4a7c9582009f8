#include "engine/forces/terms.hpp"
#include "tests/forces/test_cell.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <set>

// Claims that hold for every force term; a new row of the table is tested by itself.
namespace spheroscope::test {
namespace {

constexpr std::uint64_t k_n_seeds = 20;
constexpr double k_noise = 0.12;  // of the mean edge; no triangle turns over

class EveryTerm : public testing::TestWithParam<std::size_t> {
  protected:
    const ForceTermRow& row = force_terms()[GetParam()];
    std::unique_ptr<ForceTerm> term = make_term(GetParam());
};

class InternalTerm : public EveryTerm {};

std::vector<std::size_t> internal_rows() {
    std::vector<std::size_t> rows;
    for (std::size_t row = 0; row < force_terms().size(); ++row)
        if (force_terms()[row].internal) rows.push_back(row);
    return rows;
}

/// -dE/dx by central differences.
std::vector<Vec3> energy_slope(TestCell& test, const ForceTerm& term, double h_um) {
    std::vector<Vec3> F(test.n_nodes());
    for (std::size_t i = 0; i < F.size(); ++i)
        for (int axis = 0; axis < 3; ++axis) {
            double& x = test.x()[i][axis];
            const double start = x;
            x = start + h_um;
            test.update();
            const double above = test.energy_fJ(term);
            const double x_above = x;
            x = start - h_um;
            test.update();
            F[i][axis] = -(above - test.energy_fJ(term)) / (x_above - x);
            x = start;
        }
    test.update();
    return F;
}

// C-1. The error of a central difference is (h/length)^2/6 with length ~ 1 um, the smallest height
// of a shaken triangle: below 1e-7 at h = 2e-4 um.
TEST_P(EveryTerm, ForceIsMinusTheSlopeOfTheEnergy) {
    for (std::uint64_t seed = 0; seed < k_n_seeds; ++seed) {
        SCOPED_TRACE(seed);
        TestCell test(42);
        test.shake(seed, k_noise);
        const std::vector<Vec3> F = test.force_nN(*term);
        ASSERT_GT(norm(F), 0.0) << "the term is silent, the test would see nothing";
        EXPECT_LT(distance(energy_slope(test, *term, 2e-4), F), 1e-7 * norm(F));
    }
}

// C-1. An error in the force that is small but not a rounding error does not fall with h^2.
TEST_P(EveryTerm, DifferenceQuotientApproachesTheForceWithTheSquareOfTheStep) {
    TestCell test(162);
    test.shake(3, k_noise);
    const std::vector<Vec3> F = test.force_nN(*term);
    const double rounding = 1e-9 * norm(F);  // of E/h, over F
    double last = distance(energy_slope(test, *term, 8e-3), F);
    for (const double h_um : {4e-3, 2e-3}) {
        const double error = distance(energy_slope(test, *term, h_um), F);
        // 4 for a smooth energy; a corner inside the step makes it a little irregular.
        EXPECT_LT(error, last / 3.0 + rounding);
        last = error;
    }
}

TEST_P(EveryTerm, ForceAtRestIsMinusTheSlopeOfTheEnergy) {
    TestCell test(42);
    TestCell shaken(42);
    shaken.shake(1, k_noise);
    EXPECT_LT(distance(energy_slope(test, *term, 2e-4), test.force_nN(*term)),
              1e-7 * norm(shaken.force_nN(*term)));
}

TEST_P(EveryTerm, RestShapeCarriesNoForceWhereTheTableSaysSo) {
    for (const int n_nodes : {42, 162}) {
        const TestCell test(n_nodes);
        TestCell shaken(n_nodes);
        shaken.shake(1, k_noise);
        const double relative = norm(test.force_nN(*term)) / norm(shaken.force_nN(*term));
        if (row.zero_at_rest)
            EXPECT_LT(relative, 1e-13);
        else
            EXPECT_GT(relative, 1e-4);
    }
}

// What is silent in part of space must not take 'not a number' for 'inside'.
TEST_P(EveryTerm, CoordinateThatIsNotANumberShowsInTheEnergyAndTheForce) {
    TestCell test(42);
    test.x()[17][1] = std::numeric_limits<double>::quiet_NaN();
    test.update();
    EXPECT_TRUE(std::isnan(test.energy_fJ(*term)));
    if (row.name != "body_force" && row.name != "load.held") {  // the same force everywhere
        EXPECT_TRUE(std::isnan(norm(test.force_nN(*term))));
    }
}

// C-2.
TEST_P(EveryTerm, ForcesHaveNoSumAndNoTorqueExactlyWhereTheTableSaysInternal) {
    for (std::uint64_t seed = 0; seed < k_n_seeds; ++seed) {
        TestCell test(162);
        test.shake(seed, k_noise);
        const std::vector<Vec3> F = test.force_nN(*term);
        Vec3 sum = Vec3::Zero(), torque = Vec3::Zero();
        double magnitude = 0.0;
        for (std::size_t i = 0; i < F.size(); ++i) {
            sum += F[i];
            torque += test.x()[i].cross(F[i]);
            magnitude += F[i].norm();
        }
        ASSERT_GT(magnitude, 0.0);
        if (row.internal) {
            EXPECT_LT(sum.norm(), 1e-12 * magnitude);
            EXPECT_LT(torque.norm(), 1e-12 * magnitude * test.model.radius_um[TestCell::cell]);
        } else {
            EXPECT_GT(sum.norm(), 1e-3 * magnitude);
        }
    }
}

TEST_P(InternalTerm, ForcesTurnWithTheCell) {
    const Mat3 turn = Eigen::AngleAxisd(1.1, Vec3(0.3, -0.5, 0.8).normalized()).toRotationMatrix();
    TestCell test(162);
    test.shake(5, k_noise);
    std::vector<Vec3> F = test.force_nN(*term);
    const double energy = test.energy_fJ(*term);
    for (Vec3& x : test.x()) x = turn * x + Vec3(1.0, 2.0, -3.0);
    test.update();
    for (Vec3& f : F) f = turn * f;
    EXPECT_LT(distance(test.force_nN(*term), F), 1e-12 * norm(F));
    EXPECT_NEAR(test.energy_fJ(*term), energy, 1e-12 * std::abs(energy));
}

// Coordinates of 1e6 um have digits down to 1e-10 um. The cell is first put on that grid, so that
// moving it back is exact and only the arithmetic of the terms is compared.
TEST_P(InternalTerm, ForcesKeepTheirDigitsFarFromTheOrigin) {
    const Vec3 offset(1048576.0, -1048576.0, 1048576.0);
    TestCell test(162);
    test.shake(6, k_noise);
    for (Vec3& x : test.x()) x = (x + offset) - offset;
    test.update();
    const std::vector<Vec3> near = test.force_nN(*term);
    for (Vec3& x : test.x()) x += offset;
    test.update();
    EXPECT_LT(distance(test.force_nN(*term), near), 1e-12 * norm(near));
}

INSTANTIATE_TEST_SUITE_P(Terms, EveryTerm, testing::Range(std::size_t{0}, force_terms().size()),
                         name_of_row);

INSTANTIATE_TEST_SUITE_P(Terms, InternalTerm, testing::ValuesIn(internal_rows()), name_of_row);

TEST(ForceTermTable, HasOneRowForEveryTermUnderItsOwnName) {
    const auto terms = make_all_terms();
    ASSERT_EQ(terms.size(), force_terms().size());
    std::set<std::string_view> names;
    for (std::size_t row = 0; row < terms.size(); ++row) {
        EXPECT_EQ(terms[row]->name(), force_terms()[row].name);
        EXPECT_TRUE(names.insert(terms[row]->name()).second);
    }
}

TEST(ForceTermTable, NamesFilesThatExist) {
    for (const ForceTermRow& row : force_terms())
        EXPECT_TRUE(std::filesystem::exists(std::filesystem::path(SPHEROSCOPE_SOURCE_DIR) /
                                            std::string(row.file)))
            << row.file;
}

}  // namespace
}  // namespace spheroscope::test
