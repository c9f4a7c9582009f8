#include "engine/contact/triangle_pair.hpp"
#include "engine/measures/field_functions.hpp"
#include "tests/measures/made_up_contacts.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace spheroscope::test {
namespace {

constexpr std::size_t k_n_triangles = 80;

/// Two cells with one large flat triangle each, equal and face to face; the contact is that of
/// these two.
struct FlatFaces {
    FlatFaces(double gap_um, const ContactLaw& law)
        : model(make_model(make_icosphere(42), {5.0, 5.0})) {
        for (const double z_um : {-20.0, 20.0})
            for (const Vec3& x : model.topology->unit_shape)
                x_um.push_back(0.1 * x + Vec3(0.0, 0.0, z_um));
        const auto& face = model.topology->triangles[triangle];
        const std::array<Vec3, 3> corner{Vec3(-1.0, -0.7, 0.0), Vec3(1.1, -0.5, 0.0),
                                         Vec3(0.1, 1.2, 0.0)};
        TriangleGeometry lower, upper;
        for (std::size_t i = 0; i < 3; ++i) {
            lower.corner_um[i] = corner[i];
            upper.corner_um[i] = corner[(3 - i) % 3] + Vec3(0.0, 0.0, gap_um);
            x_um[static_cast<std::size_t>(face[i])] = lower.corner_um[i];
            x_um[static_cast<std::size_t>(42 + face[i])] = upper.corner_um[i];
        }
        geometry = geometry_of(model, x_um, Need::triangles | Need::volumes);
        lower.normal = geometry.normal[triangle];
        upper.normal = geometry.normal[k_n_triangles + triangle];
        EXPECT_LE((lower.normal - Vec3::UnitZ()).norm(), 1e-15);
        EXPECT_LE((upper.normal + Vec3::UnitZ()).norm(), 1e-15);
        contacts.clear(2);
        ContactPair pair;
        if (contact_of_triangles(lower, upper, law, pair) != PairOutcome::active) return;
        pair.triangle_a = pair.triangle_b = static_cast<int>(triangle);
        contacts.groups.push_back({0, 1, {pair}});
        contacts.index_sides(2);
    }
    [[nodiscard]] Configuration at() const {
        return {model, x_um, volume_integral_s, geometry, contacts};
    }
    static constexpr std::size_t triangle = 11;
    Model model;
    std::vector<Vec3> x_um;
    std::vector<double> volume_integral_s{0.0, 0.0};
    Geometry geometry;
    Contacts contacts;
};

MeasureInput bare_input(const Configuration& at) {
    return {.at = at,
            .v_um_per_s = {},
            .spring_nN_per_um = {},
            .pressure_kPa = {},
            .cell_stress_kPa = {}};
}

TEST(ContactStress, OfTwoFlatFacesIsMinusThePressureOfTheLaw) {
    const ContactLaw law = adhesive_law(0.5, 0.3, 2.0, 0.0);
    for (const double gap_um : {-0.2, 0.0, 0.3, 0.55}) {
        const FlatFaces faces(gap_um, law);
        ASSERT_EQ(faces.contacts.n_pairs(), 1U) << gap_um;
        const Configuration at = faces.at();
        std::vector<float> sigma_nn(2 * k_n_triangles), shear(2 * k_n_triangles);
        compute_sigma_nn(bare_input(at), sigma_nn);
        compute_shear(bare_input(at), shear);
        for (const std::size_t t : {FlatFaces::triangle, k_n_triangles + FlatFaces::triangle}) {
            // Repulsion (overlap) is negative, adhesion positive: tension.
            EXPECT_NEAR(static_cast<double>(sigma_nn[t]), -law.pressure_kPa(0.6 - gap_um), 1e-6);
            EXPECT_NEAR(static_cast<double>(shear[t]), 0.0, 1e-7);
        }
    }
}

TEST(ContactStress, IsNotANumberWhereThereIsNoContact) {
    const ContactLaw law = adhesive_law(0.5, 0.3, 2.0, 0.0);
    for (const double gap_um : {0.2, 0.7}) {
        const FlatFaces faces(gap_um, law);
        const Configuration at = faces.at();
        std::vector<float> sigma_nn(2 * k_n_triangles), shear(2 * k_n_triangles), of_cell(2);
        compute_sigma_nn(bare_input(at), sigma_nn);
        compute_shear(bare_input(at), shear);
        std::size_t n_numbers = 0;
        for (std::size_t t = 0; t < sigma_nn.size(); ++t) {
            EXPECT_EQ(std::isnan(sigma_nn[t]), std::isnan(shear[t]));
            if (!std::isnan(sigma_nn[t])) ++n_numbers;
        }
        EXPECT_EQ(n_numbers, gap_um < 0.6 ? 2U : 0U);
        compute_anisotropic_max(bare_input(at), of_cell);
        EXPECT_EQ(std::isnan(of_cell[0]), gap_um > 0.6);
        compute_anisotropic_mean(bare_input(at), of_cell);
        EXPECT_EQ(std::isnan(of_cell[1]), gap_um > 0.6);
    }
}

TEST(ContactStress, SplitsAForceAlongTheNormalAndAcrossIt) {
    MadeUpContacts cells({Vec3::Zero(), Vec3(0.0, 0.0, 9.0)});
    const std::size_t t = 25;
    const Vec3 n_A = cells.geometry.normal[t];
    const Vec3 across = n_A.unitOrthogonal();
    // The force on A points inwards, 30 degrees off its normal.
    const Vec3 n = -std::cos(0.5236) * n_A + std::sin(0.5236) * across;
    cells.set({{0, 1, 25, 60, n, {0.2, 0.3, 0.5}, {0.2, 0.3, 0.5}}});
    const Configuration at = cells.at();
    std::vector<float> sigma_nn(2 * k_n_triangles), shear(2 * k_n_triangles);
    compute_sigma_nn(cells.input(at), sigma_nn);
    compute_shear(cells.input(at), shear);
    const double area_um2 = cells.geometry.area_um2[t];
    EXPECT_NEAR(static_cast<double>(sigma_nn[t]), -std::cos(0.5236) / area_um2, 1e-7);
    EXPECT_NEAR(static_cast<double>(shear[t]), std::sin(0.5236) / area_um2, 1e-7);
    // On B the force is the opposite one.
    const std::size_t b = k_n_triangles + 60;
    EXPECT_NEAR(static_cast<double>(sigma_nn[b]),
                -n.dot(cells.geometry.normal[b]) / cells.geometry.area_um2[b], 1e-7);
}

TEST(AnisotropicStress, IsTheSpreadOfTheNormalStressOverTheTouchingTriangles) {
    MadeUpContacts cells({Vec3::Zero(), Vec3(0.0, 0.0, 9.0)});
    std::vector<MadeUpContacts::Push> pushes;
    constexpr int n = 21;
    for (int t = 0; t < n; ++t) {
        const auto s = static_cast<std::size_t>(t);
        // sigma_nn = 0.01 t: the force on A along its normal, tension.
        const double f = 0.01 * t * cells.geometry.area_um2[s] / 3.0;
        pushes.push_back({0, 1, t, 5, cells.geometry.normal[s], {f, f, f}, {f, f, f}});
    }
    cells.set(pushes);
    const Configuration at = cells.at();
    std::vector<float> largest(2), mean(2);
    compute_anisotropic_max(cells.input(at), largest);
    compute_anisotropic_mean(cells.input(at), mean);
    EXPECT_NEAR(static_cast<double>(largest[0]), 0.01 * 0.9 * (n - 1), 1e-6);
    EXPECT_NEAR(static_cast<double>(mean[0]), 0.01 * std::sqrt((n * n - 1) / 12.0), 1e-6);
    EXPECT_EQ(largest[1], 0.0F) << "one triangle has no spread";
}

}  // namespace
}  // namespace spheroscope::test
