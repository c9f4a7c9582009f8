#include "engine/measures/field_functions.hpp"
#include "tests/reference/made_up_cells.hpp"

#include <gtest/gtest.h>

namespace spheroscope::test {
namespace {

constexpr double k_E_kPa = 20.0;

/// gamma_eff (or gamma_total) of every node of two cells, both stretched by 1 + s.
std::vector<float> tension_of(const Model& model, double s, double gamma,
                              std::span<const double> springs,
                              void (*compute)(const MeasureInput&, std::span<float>)) {
    const std::vector<Vec3> centres{Vec3::Zero(), Vec3(30.0, 0.0, 0.0)};
    std::vector<Vec3> x = turned_cells(model, centres, 3);
    for (int cell = 0; cell < 2; ++cell)
        for (Vec3& node : model.cell_nodes(std::span<Vec3>(x), cell)) {
            const Vec3& centre = centres[static_cast<std::size_t>(cell)];
            node = centre + (1.0 + s) * (node - centre);
        }
    const Geometry geometry;
    Contacts contacts;
    contacts.clear(2);
    const std::vector<double> integral(2, 0.0);
    const Configuration at{model, x, integral, geometry, contacts};
    MeasureInput input{.at = at,
                       .v_um_per_s = {},
                       .spring_nN_per_um = springs,
                       .pressure_kPa = {},
                       .cell_stress_kPa = {}};
    input.gamma_nN_per_um = gamma;
    std::vector<float> out(model.n_all_nodes());
    compute(input, out);
    return out;
}

TEST(SurfaceTension, OfAUniformStretchIsThreeHalvesOfEtTimesTheStretch) {
    const Model model = make_model(make_icosphere(642), {6.0, 9.0});
    const std::vector<double> springs = springs_nN_per_um(model, k_E_kPa);
    for (const double s : {-0.01, 1e-3, 0.02}) {
        const std::vector<float> gamma_eff = tension_of(model, s, 0.5, springs, compute_gamma_eff);
        const double expected = 1.5 * k_E_kPa * k_thickness_um * s / (1.0 + s);
        double mean = 0.0;
        for (std::size_t i = 0; i < gamma_eff.size(); ++i) {
            const std::size_t node = i % 642;
            const int degree =
                model.topology->neighbour_begin[node + 1] - model.topology->neighbour_begin[node];
            const double value = static_cast<double>(gamma_eff[i]);
            mean += value / static_cast<double>(gamma_eff.size());
            // The mesh is not regular: triangles around a node differ by some percent.
            if (degree == 6) {
                EXPECT_NEAR(value / expected, 1.0, 0.08) << "node " << i;
            }
        }
        EXPECT_NEAR(mean / expected, 1.0, 0.01) << "stretch " << s;
    }
}

TEST(SurfaceTension, IsZeroInTheRestShapeAndTotalAddsTheActiveTension) {
    const Model model = make_model(make_icosphere(42), {6.0, 9.0});
    const std::vector<double> springs = springs_nN_per_um(model, k_E_kPa);
    for (const float value : tension_of(model, 0.0, 0.5, springs, compute_gamma_eff))
        EXPECT_NEAR(static_cast<double>(value), 0.0, 1e-12);
    const std::vector<float> elastic = tension_of(model, 0.01, 0.5, springs, compute_gamma_eff);
    const std::vector<float> total = tension_of(model, 0.01, 0.5, springs, compute_gamma_total);
    for (std::size_t i = 0; i < total.size(); ++i)
        EXPECT_NEAR(static_cast<double>(total[i]), 0.5 + static_cast<double>(elastic[i]), 1e-7);
    // Without springs it is the active tension everywhere.
    for (const float value : tension_of(model, 0.01, 0.5, {}, compute_gamma_total))
        EXPECT_EQ(value, 0.5F);
}

}  // namespace
}  // namespace spheroscope::test
