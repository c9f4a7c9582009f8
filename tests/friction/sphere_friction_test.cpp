// Friction of one cell that moves as a rigid body or grows, against the closed forms of a sphere.
#include "engine/friction/cortex_viscosity.hpp"
#include "tests/reference/made_up_cells.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace spheroscope::test {
namespace {

constexpr double k_R_um = 9.0, k_eta_f = 0.05, k_eta = 1.0, k_pi = std::numbers::pi;

/// A cell with drag and cortex viscosity, evaluated at its rest shape.
System system_of(const Model& model, const PartValues& values) {
    return {model, make_parts(values), 1, Need::triangles | Need::volumes};
}

std::vector<Vec3> rest_positions(const Model& model) {
    std::vector<Vec3> x_um;
    for (const Vec3& x : model.topology->unit_shape) x_um.push_back(model.radius_um[0] * x);
    return x_um;
}

TEST(Friction, OfAnEdgeIsTheSurfaceViscosityOverRootThree) {
    EXPECT_NEAR(edge_friction_nN_s_per_um(1.0, 0.2), 0.115470, 1e-6);
}

TEST(Drag, OfAForceOnAWholeCellIsStokes) {
    PartValues values;
    values.eta_kPa_s = k_eta;
    values.body_force_nN = Vec3(0.0, 1.0, 0.0);
    const Model model = make_model(make_icosphere(642), {k_R_um});
    System system = system_of(model, values);
    const std::vector<double> integral(1, 0.0);
    ASSERT_FALSE(system.evaluate(rest_positions(model), integral, 0.0));
    std::vector<Vec3> v(model.n_all_nodes(), Vec3::Zero());
    ASSERT_TRUE(system.solve_friction(system.force_nN(), v, 1e-12).converged);
    // The area of the mesh takes the place of 4 pi R^2.
    const double mesh_area_um2 = k_R_um * k_R_um * model.unit_area;
    const double expected = 1.0 / (1.5 * k_eta_f / k_R_um * mesh_area_um2);
    for (const Vec3& node : v) EXPECT_LE((node - Vec3(0.0, expected, 0.0)).norm(), 1e-12);
    EXPECT_NEAR(v[0].y(), 1.0 / (6.0 * k_pi * k_eta_f * k_R_um), 0.01 * 0.118);
}

TEST(RigidSpin, IsResistedByDragAndByTheCortex) {
    // The cortex friction acts on the whole relative velocity of two nodes, so it resists rotation
    // too.
    PartValues values;
    values.eta_kPa_s = k_eta;
    const Model model = make_model(make_icosphere(642), {k_R_um});
    System system = system_of(model, values);
    const std::vector<double> integral(1, 0.0);
    const std::vector<Vec3> x = rest_positions(model);
    ASSERT_FALSE(system.evaluate(x, integral, 0.0));
    const double t_um = k_thickness_um;
    const double cortex = 16.0 * k_pi / 3.0 * k_eta * t_um * k_R_um * k_R_um;
    const double drag = 4.0 * k_pi * k_eta_f * std::pow(k_R_um, 3);
    EXPECT_NEAR(cortex, 271.0, 1.0);
    EXPECT_NEAR(drag, 458.0, 1.0);
    for (const Vec3& axis : {Vec3(1.0, 0.0, 0.0), Vec3(0.6, 0.0, 0.8)}) {
        std::vector<Vec3> v, out(x.size());
        for (const Vec3& node : x) v.emplace_back(axis.cross(node));
        system.velocity_system(0.0, {}).product(v, out, system.workers());
        Vec3 torque = Vec3::Zero();
        for (std::size_t i = 0; i < x.size(); ++i) torque += x[i].cross(out[i]);
        EXPECT_NEAR(torque.dot(axis), cortex + drag, 0.02 * (cortex + drag));
        const std::vector<double> drags = node_drags(model, k_eta_f);
        double torque_of_drag = 0.0;
        for (std::size_t i = 0; i < x.size(); ++i)
            torque_of_drag += axis.dot(x[i].cross(drags[i] * v[i]));
        EXPECT_NEAR(torque_of_drag, drag, 0.02 * drag);
    }
}

/// eps' per pressure, 1/(s kPa), of a cell that a pressure alone starts to inflate.
double breathing_rate(const Model& model) {
    PartValues values;
    values.eta_kPa_s = k_eta;
    System system = system_of(model, values);
    const std::vector<double> integral(1, 0.0);
    EXPECT_FALSE(system.evaluate(rest_positions(model), integral, 0.0));
    const std::vector<Vec3>& S = system.geometry().volume_gradient_um2;
    std::vector<Vec3> v(S.size(), Vec3::Zero());
    EXPECT_TRUE(system.solve_friction(S, v, 1e-12).converged);
    double volume_rate = 0.0;
    for (std::size_t i = 0; i < S.size(); ++i) volume_rate += S[i].dot(v[i]);
    return volume_rate / system.geometry().volume_um3[0];
}

TEST(Breathing, StartsAtTheRateOfTheClosedForm) {
    // r' = dP / (2 eta t/R^2 + 3 eta_f/2R), eps' = 3 r'/R.
    const double closed_form =
        3.0 / k_R_um / (2.0 * k_eta * k_thickness_um / (k_R_um * k_R_um) + 1.5 * k_eta_f / k_R_um);
    EXPECT_NEAR(closed_form, 25.12, 0.01);
    EXPECT_NEAR(breathing_rate(model_with_nodes_on_sphere(642, k_R_um)), closed_form,
                0.005 * closed_form);
    // With the mesh scaled to the sphere's volume, the radius of its nodes is 0.3 % larger.
    EXPECT_NEAR(breathing_rate(make_model(make_icosphere(642), {k_R_um})), closed_form,
                0.006 * closed_form);
    EXPECT_NEAR(breathing_rate(make_model(make_icosphere(2562), {k_R_um})), closed_form,
                0.002 * closed_form);
}

TEST(Breathing, ConvergesWithTheMeshAsFoundBefore) {
    // Nodes on the sphere itself; the digits were found with an independent program.
    EXPECT_NEAR(breathing_rate(model_with_nodes_on_sphere(42, k_R_um)), 23.5, 0.05);
    EXPECT_NEAR(breathing_rate(model_with_nodes_on_sphere(162, k_R_um)), 24.70, 0.005);
    EXPECT_NEAR(breathing_rate(model_with_nodes_on_sphere(642, k_R_um)), 25.01, 0.005);
    EXPECT_NEAR(breathing_rate(model_with_nodes_on_sphere(2562, k_R_um)), 25.09, 0.005);
}

}  // namespace
}  // namespace spheroscope::test
