#include "engine/measures/field_functions.hpp"
#include "engine/measures/fields.hpp"
#include "engine/measures/totals.hpp"
#include "tests/measures/made_up_contacts.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

namespace spheroscope::test {
namespace {

Totals totals_of(MadeUpContacts& cells) {
    const Configuration at = cells.at();
    return compute_totals(cells.input(at));
}

TEST(Totals, CountCellsAsTouchingAboveTheThresholdOnly) {
    MadeUpContacts cells({Vec3::Zero(), Vec3(0, 0, 10), Vec3(0, 10, 0)});
    const Vec3 z = Vec3::UnitZ();
    const std::array<double, 3> f{0.1, 0.1, 0.1};
    cells.set(
        {{0, 1, 3, 4, -z, f, f, 2.0}, {0, 1, 5, 6, -z, f, f, 3.0}, {1, 2, 7, 8, z, f, f, 0.08}});
    const Totals totals = totals_of(cells);
    double surface_um2 = 0.0;
    for (const double area_um2 : cells.geometry.area_um2) surface_um2 += area_um2;
    EXPECT_NEAR(totals.contact_area_um2, 5.08, 1e-12);
    EXPECT_NEAR(totals.contact_fraction, 2.0 * 5.08 / surface_um2, 1e-12);
    EXPECT_NEAR(totals.coordination_Z, 2.0 * 1.0 / 3.0, 1e-12)
        << "0.08 um^2 is no contact of cells";
    std::vector<float> neighbours(3);
    const Configuration at = cells.at();
    MeasureInput input = cells.input(at);
    compute_neighbours(input, neighbours);
    EXPECT_EQ(neighbours, (std::vector<float>{1.0F, 1.0F, 0.0F}));
    input.touching_area_um2 = 0.05;
    EXPECT_NEAR(compute_totals(input).coordination_Z, 4.0 / 3.0, 1e-12);
}

TEST(Totals, TakeTheCellsTwoMeanRadiiBelowTheSurfaceAsTheCore) {
    // 64 equal cells fill a sphere of four radii, 20 um: the core is what lies within 10 um.
    std::vector<Vec3> centres;
    for (int i = 0; i < 64; ++i) {
        const double distance_um = i < 6 ? 9.0 : 15.0;
        const double sign = i % 2 == 0 ? 1.0 : -1.0;  // in opposite pairs: the centre stays at 0
        const double angle = 0.1 * (i / 2);
        centres.push_back(sign * distance_um * Vec3(std::cos(angle), std::sin(angle), 0.0));
    }
    MadeUpContacts cells(centres);
    for (std::size_t c = 0; c < 64; ++c)
        cells.stress_kPa[c] =
            (c < 6 ? -0.02 - 0.001 * static_cast<double>(c) : 0.005) * Mat3::Identity();
    cells.geometry.volume_um3[0] *= 1.5;
    const Configuration at = cells.at();
    MeasureInput input = cells.input(at);
    input.omega_nN_per_um = 0.5;
    input.W_nN_per_um = 0.25;
    const Totals totals = compute_totals(input);
    double volume_um3 = 0.0;
    for (const double v : cells.geometry.volume_um3) volume_um3 += v;
    const double R = std::cbrt(3.0 * volume_um3 / (4.0 * std::numbers::pi));
    EXPECT_NEAR(R, 20.0, 0.1);
    EXPECT_NEAR(totals.R_th_um, R, 1e-12);
    EXPECT_EQ(totals.n_core_cells, 6);
    const double core = -0.02 - 0.001 * 2.5;
    EXPECT_NEAR(totals.sigma_h_core_kPa, core, 1e-15);
    EXPECT_NEAR(totals.sigma_h_core_by_volume_kPa,
                (1.5 * -0.02 - 0.021 - 0.022 - 0.023 - 0.024 - 0.025) / 6.5, 1e-9);
    EXPECT_NEAR(totals.sigma_h_rim_kPa, 0.005, 1e-15);
    EXPECT_NEAR(totals.eps_YL_omega, 1.0 + core * R / (2.0 * 0.5), 1e-12);
    EXPECT_NEAR(totals.eps_YL_W, 1.0 + core * R / 0.25, 1e-12);
    double virial = 0.0, size = 0.0;
    for (std::size_t c = 0; c < 64; ++c) {
        virial += cells.geometry.volume_um3[c] * cells.stress_kPa[c].trace() / 3.0;
        size += cells.geometry.volume_um3[c] * std::abs(cells.stress_kPa[c].trace()) / 3.0;
    }
    EXPECT_NEAR(totals.virial_defect, std::abs(virial) / size, 1e-12);
    EXPECT_NEAR(totals.sigma_h_mean_kPa, virial / volume_um3, 1e-15);
    EXPECT_NEAR(totals.sigma_h_size_kPa, size / volume_um3, 1e-15);
}

TEST(Totals, AreUndefinedWhereThereIsNothingToMeasure) {
    MadeUpContacts cells({Vec3::Zero(), Vec3(0, 0, 20)});
    Totals totals = totals_of(cells);
    EXPECT_EQ(totals.coordination_Z, 0.0);
    EXPECT_EQ(totals.n_core_cells, 0);
    EXPECT_TRUE(std::isnan(totals.sigma_h_core_kPa));
    EXPECT_TRUE(std::isnan(totals.eps_YL_omega));
    EXPECT_TRUE(std::isnan(totals.virial_defect)) << "0/0";
    EXPECT_TRUE(std::isnan(totals.energy_fJ)) << "the run knows it";
    // Without contacts in the model
    cells.stress_kPa.clear();
    cells.pressure_kPa.clear();
    totals = totals_of(cells);
    EXPECT_TRUE(std::isnan(totals.coordination_Z));
    EXPECT_TRUE(std::isnan(totals.contact_fraction));
    EXPECT_TRUE(std::isnan(totals.mean_pressure_kPa));
    EXPECT_FALSE(std::isnan(totals.volume_error));
}

TEST(Totals, DescribeTheMeshAsItIs) {
    MadeUpContacts cells({Vec3::Zero(), Vec3(0, 0, 20)});
    const Totals good = totals_of(cells);
    EXPECT_EQ(good.n_flipped_triangles, 0);
    EXPECT_EQ(good.n_folds, 0);
    EXPECT_GT(good.smallest_triangle, 0.7);
    EXPECT_LE(good.smallest_triangle, 1.0);
    EXPECT_NEAR(good.volume_error, 0.0, 1e-12);
    EXPECT_NEAR(good.mean_pressure_kPa, 0.1, 1e-15);

    // Cell 1 by a tenth larger in every direction
    for (std::size_t i = 42; i < 84; ++i)
        cells.x_um[i] = Vec3(0, 0, 20) + 1.1 * (cells.x_um[i] - Vec3(0, 0, 20));
    cells.set({});
    EXPECT_NEAR(totals_of(cells).volume_error, std::pow(1.1, 3) - 1.0, 1e-12);

    // A node pulled through the cell turns the triangles around it inside out.
    MadeUpContacts flipped({Vec3::Zero()});
    flipped.x_um[0] = -0.8 * flipped.x_um[0];
    flipped.set({});
    EXPECT_GE(totals_of(flipped).n_flipped_triangles, 5);

    // A node drawn along the surface over one of its neighbours folds the triangles between them
    // over.
    MadeUpContacts folded({Vec3::Zero()});
    const auto neighbour = static_cast<std::size_t>(folded.model.topology->neighbours[0]);
    folded.x_um[0] += 1.8 * (folded.x_um[neighbour] - folded.x_um[0]);
    folded.set({});
    EXPECT_GE(totals_of(folded).n_folds, 2);

    // A triangle that collapses shows as the smallest.
    MadeUpContacts thin({Vec3::Zero()});
    const auto& [i, j, k] = thin.model.topology->triangles[0];
    thin.x_um[static_cast<std::size_t>(i)] =
        0.5 * (thin.x_um[static_cast<std::size_t>(j)] + thin.x_um[static_cast<std::size_t>(k)]) +
        1e-3 * thin.x_um[static_cast<std::size_t>(i)];
    thin.set({});
    double smallest = 1e30, total = 0.0;
    for (const double area_um2 : thin.geometry.area_um2) {
        smallest = std::min(smallest, area_um2);
        total += area_um2;
    }
    EXPECT_NEAR(totals_of(thin).smallest_triangle, smallest / (total / 80.0), 1e-12);
    EXPECT_LT(totals_of(thin).smallest_triangle, 0.1);
}

TEST(Totals, SplitSpeedsAlongTheNormalsAndAcrossThem) {
    MadeUpContacts cells({Vec3::Zero(), Vec3(0, 0, 20)});
    for (std::size_t i = 0; i < cells.x_um.size(); ++i)
        cells.v_um_per_s[i] = 0.3 * cells.geometry.volume_gradient_um2[i].normalized();
    Totals totals = totals_of(cells);
    EXPECT_NEAR(totals.normal_speed_rms_um_per_s, 0.3, 1e-12);
    EXPECT_NEAR(totals.tangential_speed_max_um_per_s, 0.0, 1e-7);
    EXPECT_NEAR(totals.cell_speed_max_um_per_s, 0.0, 0.01);

    // One cell spins: along the surface only. The other one goes on as a whole.
    for (std::size_t i = 0; i < 42; ++i)
        cells.v_um_per_s[i] = Vec3(0.0, 0.0, 0.02).cross(cells.x_um[i]);
    std::fill(cells.v_um_per_s.begin() + 42, cells.v_um_per_s.end(), Vec3::Zero());
    totals = totals_of(cells);
    EXPECT_NEAR(totals.tangential_speed_max_um_per_s, 0.1, 0.005);
    EXPECT_LT(totals.normal_speed_rms_um_per_s, 0.01);
    std::fill(cells.v_um_per_s.begin() + 42, cells.v_um_per_s.end(), Vec3(0.0, 0.4, 0.3));
    EXPECT_NEAR(totals_of(cells).cell_speed_max_um_per_s, 0.5, 1e-12);
}

TEST(Tables, OfFieldsAndTotalsHaveOneRowForEachName) {
    std::set<std::string_view> names;
    for (const Field& field : all_fields()) {
        EXPECT_TRUE(names.insert(field.name).second) << field.name;
        EXPECT_EQ(find_field(field.name), &field);
    }
    EXPECT_EQ(find_field("sigma"), nullptr);
    names.clear();
    Totals totals{};
    totals.R_th_um = 12.5;
    totals.n_folds = 3;
    for (const TotalsRow& row : all_totals()) {
        EXPECT_TRUE(names.insert(row.name).second) << row.name;
        EXPECT_EQ(value_of(row, totals), row.name == "R_th"      ? 12.5
                                         : row.name == "n_folds" ? 3.0
                                                                 : 0.0)
            << row.name;
    }
}

TEST(Totals, TakeTheDeepestNodeFromTheSurfaceOfTheCellThatItIsIn) {
    Workers workers(1);
    MadeUpContacts apart({Vec3::Zero(), Vec3(0, 0, 10.5)});
    EXPECT_EQ(compute_deepest_node_um(apart.at(), workers), 0.0);
    // Spheres of 5 um that overlap by 2 um; facets of 42 nodes lie up to half a micron below them.
    MadeUpContacts cells({Vec3::Zero(), Vec3(0, 0, 8)});
    const double deepest_um = compute_deepest_node_um(cells.at(), workers);
    EXPECT_GT(deepest_um, 1.0);
    EXPECT_LT(deepest_um, 2.5);
    EXPECT_TRUE(std::isnan(totals_of(cells).deepest_node_um)) << "only on demand";
}

}  // namespace
}  // namespace spheroscope::test
