// sigma_h under the law `variational`, from the nodes' forces alone: 3 V_a sigma_a = sum over a of
// F.(x - x_a) + Y/2 with the pair of cells' own virial Y = - sum over both of F.x.
#include "engine/measures/measure_input.hpp"
#include "tests/reference/made_up_cells.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace spheroscope::test {
namespace {

TEST(VariationalStress, IsTheVirialOfTheNodesForcesFromOutsideAndFromInside) {
    const Cluster cells = make_doublet(162, 6, 5.0, 4.0, 0.3, 0.05);
    PartValues values;
    values.contact = adhesive_law(0.5, 0.3, 2.0, 0.0);
    values.contact->form = ContactForm::variational;
    System system(cells.model, make_parts(values), 1, Need::volumes);
    const std::vector<double> no_integral(2, 0.0);
    ASSERT_FALSE(system.evaluate(cells.x_um, no_integral, 0.0).has_value());
    const Configuration at = system.configuration();

    std::array<double, 2> virial{};
    double pair_virial = 0.0, size = 0.0;
    for (int cell = 0; cell < 2; ++cell) {
        const auto F = cells.model.cell_nodes(system.force_nN(), cell);
        const auto x = cells.model.cell_nodes(at.x_um, cell);
        const Vec3& centre = at.geometry.centre_um[static_cast<std::size_t>(cell)];
        for (std::size_t i = 0; i < F.size(); ++i) {
            virial[static_cast<std::size_t>(cell)] += F[i].dot(x[i] - centre);
            pair_virial -= F[i].dot(x[i]);
            size += std::abs(F[i].dot(x[i]));
        }
    }
    ASSERT_GT(size, 1.0);
    const std::vector<Mat3> stress = cell_stress_tensors(at);
    // Nothing moves where no force is left: then the inside carries what the contacts do.
    const std::vector<Vec3> at_rest(cells.model.n_all_nodes(), Vec3::Zero());
    const std::vector<double> from_inside = hydrostatic_stress_from_inside(at, stress, at_rest);
    for (std::size_t cell = 0; cell < 2; ++cell) {
        const double V = at.geometry.volume_um3[cell];
        EXPECT_NEAR(V * stress[cell].trace(), virial[cell] + 0.5 * pair_virial, 1e-11 * size);
        EXPECT_NEAR(3.0 * V * from_inside[cell], virial[cell] + 0.5 * pair_virial, 1e-11 * size);
    }
}

TEST(VariationalStress, SumsToZeroWhereTheContactForcesOfEachCellDo) {
    // sum V sigma_h = - 1/3 sum of a cell's contact force times its centre: no other part is left.
    const Cluster cells = make_cluster(162, 3, 0.4, 0.05);
    PartValues values;
    values.contact = adhesive_law(0.5, 0.3, 2.0, 0.0);
    values.contact->form = ContactForm::variational;
    System system(cells.model, make_parts(values), 1, Need::volumes);
    const std::vector<double> no_integral(cells.model.radius_um.size(), 0.0);
    ASSERT_FALSE(system.evaluate(cells.x_um, no_integral, 0.0).has_value());
    const Configuration at = system.configuration();
    const std::vector<Mat3> stress = cell_stress_tensors(at);
    double sum = 0.0, size = 0.0;
    for (int cell = 0; cell < cells.model.n_cells(); ++cell) {
        const auto c = static_cast<std::size_t>(cell);
        Vec3 force = Vec3::Zero();
        for (const Vec3& F : cells.model.cell_nodes(system.force_nN(), cell)) force += F;
        sum += at.geometry.volume_um3[c] * stress[c].trace() + force.dot(at.geometry.centre_um[c]);
        size += at.geometry.volume_um3[c] * std::abs(stress[c].trace());
    }
    ASSERT_GT(size, 1.0);
    EXPECT_NEAR(sum, 0.0, 1e-11 * size);
}

}  // namespace
}  // namespace spheroscope::test
