#include "engine/forces/contact_traction.hpp"
#include "engine/measures/field_functions.hpp"
#include "engine/measures/fields.hpp"
#include "engine/measures/pair_forces.hpp"
#include "tests/measures/made_up_contacts.hpp"
#include "tests/reference/all_pairs.hpp"

#include <gtest/gtest.h>

namespace spheroscope::test {
namespace {

constexpr double k_shift_um = 1.0;

/// Two cells that push in one place and pull in another: no net force on either.
std::vector<MadeUpContacts::Push> push_and_pull() {
    const Vec3 n = Vec3(0.6, 0.0, 0.8);
    return {{0, 1, 3, 9, n, {0.5, 0.3, 0.2}, {0.1, 0.7, 0.2}},
            {0, 1, 17, 40, n, {-0.4, -0.4, -0.2}, {-0.9, 0.2, -0.3}}};
}

MadeUpContacts two_cells() { return MadeUpContacts({Vec3::Zero(), Vec3(0.0, 1.0, 9.0)}); }

/// V_a sigma_a from the definition, with forces on nodes as vectors.
Mat3 stress_by_definition(const MadeUpContacts& cells, int cell) {
    Mat3 sum = Mat3::Zero();
    for (const Contacts::Group& group : cells.contacts.groups)
        for (const ContactPair& pair : cells.contacts.pairs_of(group)) {
            if (group.cell_a != cell && group.cell_b != cell) continue;
            for (const bool is_a : {true, false}) {
                const int of = is_a ? group.cell_a : group.cell_b;
                const auto& nodes = cells.model.topology->triangles[static_cast<std::size_t>(
                    is_a ? pair.triangle_a : pair.triangle_b)];
                for (std::size_t i = 0; i < 3; ++i) {
                    const Vec3 x = cells.model.cell_nodes(std::span<const Vec3>(cells.x_um),
                                                          of)[static_cast<std::size_t>(nodes[i])];
                    const Vec3 F = (is_a ? pair.force_a_nN[i] : -pair.force_b_nN[i]) * pair.normal;
                    if (of == cell)
                        sum += F * (x - cells.geometry.centre_um[static_cast<std::size_t>(cell)])
                                       .transpose();
                    sum -= 0.5 * F * x.transpose();  // half of the pair's own virial Y
                }
            }
        }
    return 0.5 * (sum + sum.transpose()) /
           cells.geometry.volume_um3[static_cast<std::size_t>(cell)];
}

TEST(CellStress, IsTheVirialOfTheContactForcesAndHalfOfEachPairsOwn) {
    MadeUpContacts cells = two_cells();
    cells.set(push_and_pull());
    for (int cell = 0; cell < 2; ++cell) {
        const Mat3& stress = cells.stress_kPa[static_cast<std::size_t>(cell)];
        EXPECT_GT(stress.norm(), 1e-4);
        EXPECT_LE((stress - stress_by_definition(cells, cell)).norm(), 1e-13 * stress.norm());
        EXPECT_LE((stress - stress.transpose()).norm(), 1e-16);
    }
}

TEST(CellStress, HasTheHydrostaticStressAsAThirdOfItsTraceAndRadialAndTangentialParts) {
    MadeUpContacts cells({Vec3::Zero(), Vec3(0.0, 1.0, 9.0), Vec3(1.0, -6.0, 4.0)});
    cells.set(push_and_pull());
    const Configuration at = cells.at();
    const MeasureInput input = cells.input(at);
    std::vector<float> sigma_h(3), radial(3), tangential(3);
    compute_sigma_h(input, sigma_h);
    compute_sigma_radial(input, radial);
    compute_sigma_tangential(input, tangential);
    const Vec3 centre =
        (cells.geometry.centre_um[0] + cells.geometry.centre_um[1] + cells.geometry.centre_um[2]) /
        3.0;  // equal volumes
    for (std::size_t c = 0; c < 2; ++c) {
        const double expected = cells.stress_kPa[c].trace() / 3.0;
        EXPECT_NEAR(static_cast<double>(sigma_h[c]), expected, 1e-6 * std::abs(expected));
        const Vec3 r = (cells.geometry.centre_um[c] - centre).normalized();
        EXPECT_NEAR(static_cast<double>(radial[c]), r.dot(cells.stress_kPa[c] * r), 1e-8);
        EXPECT_NEAR(static_cast<double>(radial[c]) + 2.0 * static_cast<double>(tangential[c]),
                    3.0 * expected, 1e-8);
    }
    EXPECT_EQ(sigma_h[2], 0.0F) << "touches nobody";
}

TEST(CellStress, IsStoredComponentByComponent) {
    MadeUpContacts cells = two_cells();
    cells.set(push_and_pull());
    const Configuration at = cells.at();
    const MeasureInput input = cells.input(at);
    constexpr std::array<std::array<int, 2>, 6> places{
        {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}};
    constexpr std::array<const char*, 6> names{"stress_xx", "stress_yy", "stress_zz",
                                               "stress_xy", "stress_xz", "stress_yz"};
    for (std::size_t k = 0; k < names.size(); ++k) {
        std::vector<float> values(2);
        find_field(names[k])->compute(input, values);
        for (std::size_t c = 0; c < 2; ++c)
            EXPECT_EQ(values[c],
                      static_cast<float>(cells.stress_kPa[c](places[k][0], places[k][1])));
    }
}

TEST(CellStress, ALoneCellIsAtTheCentreAndHasNoRadialDirection) {
    MadeUpContacts cells({Vec3(2.0, 3.0, 4.0)});
    const Configuration at = cells.at();
    const MeasureInput input = cells.input(at);
    std::vector<float> radial(1), tangential(1);
    compute_sigma_radial(input, radial);
    compute_sigma_tangential(input, tangential);
    EXPECT_TRUE(std::isnan(radial[0]));
    EXPECT_TRUE(std::isnan(tangential[0]));
}

TEST(CellStress, SumsToZeroOverCellsThatAreInForceBalance) {
    MadeUpContacts cells = two_cells();
    cells.set(push_and_pull());
    Mat3 sum = Mat3::Zero();
    double size = 0.0;
    for (std::size_t c = 0; c < 2; ++c) {
        sum += cells.geometry.volume_um3[c] * cells.stress_kPa[c];
        size += cells.geometry.volume_um3[c] * cells.stress_kPa[c].norm();
    }
    EXPECT_LE(sum.norm(), 1e-13 * size);
}

TEST(CellStress, DoesNotDependOnTheCentreOfACellInForceBalance) {
    MadeUpContacts cells = two_cells();
    cells.set(push_and_pull());
    const std::vector<Mat3> before = cells.stress_kPa;
    const Vec3 shift = k_shift_um * Vec3(1.0, -2.0, 2.0) / 3.0;
    cells.geometry.centre_um[0] += shift;
    EXPECT_LE((cell_stress_tensors(cells.at())[0] - before[0]).norm(), 1e-13 * before[0].norm());

    // The control: with a net force F it changes by -F shift^T / V.
    std::vector<MadeUpContacts::Push> pushes = push_and_pull();
    pushes.pop_back();
    cells.set(pushes);
    const Mat3 unbalanced = cells.stress_kPa[0];
    cells.geometry.centre_um[0] += shift;
    const Vec3 F = 1.0 * pushes[0].normal;
    const Mat3 outer = F * shift.transpose();
    const Mat3 expected =
        unbalanced - 0.5 * (outer + outer.transpose()) / cells.geometry.volume_um3[0];
    EXPECT_LE((cell_stress_tensors(cells.at())[0] - expected).norm(), 1e-13 * expected.norm());
    EXPECT_GT((expected - unbalanced).norm(), 1e-4);
}

/// Cells that overlap, with the contacts that the kernel finds.
class FoundContacts : public testing::Test {
  protected:
    FoundContacts() {
        contacts = reference::contacts_of_all_pairs(cells.model, cells.x_um, geometry, law);
        EXPECT_EQ(contacts.groups.size(), 6U);
    }
    [[nodiscard]] Configuration at() const {
        return {cells.model, cells.x_um, integral_s, geometry, contacts};
    }
    ContactLaw law = adhesive_law(0.5, 0.3, 2.0, 0.0);
    Cluster cells = make_cluster(42, 41, 0.3, 0.05);
    Geometry geometry = geometry_of(cells.model, cells.x_um, Need::triangles | Need::volumes);
    std::vector<double> integral_s = std::vector<double>(4, 0.0);
    Contacts contacts;
};

TEST_F(FoundContacts, PushBothCellsOfAPairEquallyAndOppositely) {
    const ContactTraction term{Loc{}};
    std::vector<std::vector<Vec3>> force;
    Vec3 total = Vec3::Zero(), torque = Vec3::Zero();
    double size = 0.0;
    for (int cell = 0; cell < 4; ++cell) {
        std::vector<Vec3> F(42, Vec3::Zero());
        term.add_force(at(), cell, F);
        const auto x = cells.model.cell_nodes(std::span<const Vec3>(cells.x_um), cell);
        for (std::size_t i = 0; i < F.size(); ++i) {
            total += F[i];
            torque += x[i].cross(F[i]);
            size += F[i].norm();
        }
    }
    EXPECT_GT(size, 1.0);
    EXPECT_LE(total.norm(), 1e-13 * size);
    EXPECT_LE(torque.norm(), 1e-12 * size * 5.0);
}

TEST_F(FoundContacts, HaveAPairForceWithTheSameSignForBothCells) {
    // Renaming the cells of a pair turns n and the force on 'a' around: repulsion stays repulsion.
    const std::vector<PairForce> rows = pair_forces(at());
    ASSERT_EQ(rows.size(), 6U);
    Cluster renamed = make_doublet(42, 1, 5.0, 5.0, 0.0);
    for (const PairForce& row : rows) {
        const auto nodes_of = [&](int cell) {
            return cells.model.cell_nodes(std::span<const Vec3>(cells.x_um), cell);
        };
        renamed.model = make_model(cells.model.topology, {5.0, 5.0});
        const auto b = nodes_of(row.cell_b), a = nodes_of(row.cell_a);
        renamed.x_um.assign(b.begin(), b.end());
        renamed.x_um.insert(renamed.x_um.end(), a.begin(), a.end());
        const Geometry renamed_geometry =
            geometry_of(renamed.model, renamed.x_um, Need::triangles | Need::volumes);
        const Contacts renamed_contacts =
            reference::contacts_of_all_pairs(renamed.model, renamed.x_um, renamed_geometry, law);
        const std::vector<PairForce> turned = pair_forces(
            {renamed.model, renamed.x_um, integral_s, renamed_geometry, renamed_contacts});
        ASSERT_EQ(turned.size(), 1U);
        EXPECT_NEAR(turned[0].force_nN, row.force_nN, 1e-12);
        EXPECT_NEAR(turned[0].area_um2, row.area_um2, 1e-12);
    }
}

TEST(PairForces, ArePositiveForRepulsionAndNegativeForAdhesion) {
    Cluster cells = make_doublet(162, 2, 5.0, 5.0, 0.0);
    const auto force_at = [&](double distance_um, const ContactLaw& law) {
        std::vector<Vec3> x = cells.x_um;
        for (Vec3& node : cells.model.cell_nodes(std::span<Vec3>(x), 1)) node.z() += distance_um;
        const Geometry geometry = geometry_of(cells.model, x, Need::triangles | Need::volumes);
        const Contacts contacts = reference::contacts_of_all_pairs(cells.model, x, geometry, law);
        const std::vector<double> integral(2, 0.0);
        const std::vector<PairForce> rows =
            pair_forces({cells.model, x, integral, geometry, contacts});
        EXPECT_EQ(rows.size(), 1U);
        EXPECT_EQ(rows[0].cell_a, 0);
        EXPECT_EQ(rows[0].cell_b, 1);
        EXPECT_GT(rows[0].area_um2, 0.0);
        return rows[0].force_nN;
    };
    const ContactLaw adhesive = adhesive_law(0.5, 0.3, 2.0, 0.0);
    EXPECT_LT(force_at(0.1, adhesive), 0.0);
    EXPECT_GT(force_at(-0.8, adhesive), 0.0);
    EXPECT_GT(force_at(0.1, repulsive_law(2.5, 0.3, 0.0)), 0.0);
}

TEST(StressFromInside, IsWhatTheOwnTermsCarry) {
    // By definition: all forces but the contacts', and half of the pairs' own virials.
    MadeUpContacts cells = two_cells();
    const std::vector<MadeUpContacts::Push> pushes = push_and_pull();
    cells.set(pushes);
    std::vector<Vec3> force_nN(cells.x_um.size());
    for (std::size_t i = 0; i < force_nN.size(); ++i) {
        const double k = static_cast<double>(i);
        force_nN[i] = Vec3(std::sin(k), std::cos(3.0 * k), std::sin(0.7 * k + 1.0));
    }
    std::vector<Vec3> own_nN = force_nN;
    std::array<double, 2> pair_virial_fJ{};
    const std::size_t n = force_nN.size() / 2;
    for (const MadeUpContacts::Push& push : pushes)
        for (const bool is_a : {true, false})
            for (std::size_t k = 0; k < 3; ++k) {
                const int triangle = is_a ? push.triangle_a : push.triangle_b;
                const auto cell = static_cast<std::size_t>(is_a ? push.cell_a : push.cell_b);
                const auto& nodes =
                    cells.model.topology->triangles[static_cast<std::size_t>(triangle)];
                const std::size_t i = cell * n + static_cast<std::size_t>(nodes[k]);
                const Vec3 F = (is_a ? push.force_a_nN[k] : -push.force_b_nN[k]) * push.normal;
                own_nN[i] -= F;
                for (double& virial : pair_virial_fJ) virial -= F.dot(cells.x_um[i]);
            }
    const std::vector<double> inside =
        hydrostatic_stress_from_inside(cells.at(), cells.stress_kPa, force_nN);
    for (std::size_t c = 0; c < 2; ++c) {
        double virial_fJ = 0.5 * pair_virial_fJ[c];
        for (std::size_t i = c * n; i < (c + 1) * n; ++i)
            virial_fJ -= own_nN[i].dot(cells.x_um[i] - cells.geometry.centre_um[c]);
        EXPECT_NEAR(inside[c], virial_fJ / (3.0 * cells.geometry.volume_um3[c]), 1e-12);
        EXPECT_GT(std::abs(inside[c] - cells.stress_kPa[c].trace() / 3.0), 1e-6);
    }
}

}  // namespace
}  // namespace spheroscope::test
