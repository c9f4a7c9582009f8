// Two unequal cells that adhere, at rest: their stress from the contact forces against that from
// what is inside the cells, -P + (2 gamma A + sum k (d - d*) d)/3V.
#include "engine/measures/measure_input.hpp"
#include "engine/measures/totals.hpp"
#include "tests/reference/made_up_cells.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace spheroscope::test {
namespace {

TEST(DoubletAtRest, HasTheSameHydrostaticStressFromContactsAndFromInside) {
    PartValues values = case_a_values();
    const Cluster cells = make_doublet(162, 4, 8.0, 10.0, -0.2);
    System system(cells.model, make_parts(values), 2, Need::triangles | Need::volumes);
    State state = state_at(cells.model, cells.x_um);
    MethodParameters parameters;
    parameters.dt_s = 1e-3;
    parameters.tolerance_um = 3e-3;
    parameters.linear_tolerance = 1e-6;
    const auto method = find_method("linearly_implicit")->make(parameters);
    ASSERT_TRUE(advance_until(*method, system, state, 120.0).accepted);
    ASSERT_FALSE(system.evaluate(state.x_um, state.volume_integral_s, 0.0));

    const Configuration at = system.configuration();
    const Geometry& geometry = system.geometry();
    const std::vector<Mat3> stress = cell_stress_tensors(at);
    const MeshTopology& mesh = *cells.model.topology;
    const std::vector<double> springs = springs_nN_per_um(cells.model, *values.E_kPa);
    double virial = 0.0, virial_size = 0.0;
    for (int cell = 0; cell < 2; ++cell) {
        const auto c = static_cast<std::size_t>(cell);
        const double R = cells.model.radius_um[c], V = geometry.volume_um3[c];
        double area_um2 = 0.0;
        for (const double a :
             cells.model.cell_triangles(std::span<const double>(geometry.area_um2), cell))
            area_um2 += a;
        double springs_fJ = 0.0;
        const auto x = cells.model.cell_nodes(std::span<const Vec3>(state.x_um), cell);
        for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
            const double d = (x[static_cast<std::size_t>(mesh.edges[e].j)] -
                              x[static_cast<std::size_t>(mesh.edges[e].i)])
                                 .norm();
            springs_fJ += springs[e] * (d - R * cells.model.unit_edge_length[e]) * d;
        }
        const double P = system.parts().cytosol->pressure_kPa(at, cell);
        const double from_inside =
            -P + (2.0 * *values.gamma_nN_per_um * area_um2 + springs_fJ) / (3.0 * V);
        const double from_contacts = stress[c].trace() / 3.0;
        const double scale = 2.0 * *values.gamma_nN_per_um / R;
        // The two differ by half of the pairs' own virial: little at rest, where the surfaces
        // touch.
        EXPECT_NEAR(from_inside, from_contacts, 0.01 * scale);
        EXPECT_NEAR(hydrostatic_stress_from_inside(at, stress, system.force_nN())[c], from_contacts,
                    1e-4 * scale);
        virial += V * from_contacts;
        virial_size += V * std::abs(from_contacts);
    }
    EXPECT_LE(std::abs(virial), 0.01 * virial_size);
}

}  // namespace
}  // namespace spheroscope::test
