#include "tests/reference/made_up_cells.hpp"

#include "engine/base/random.hpp"
#include "engine/forces/active_tension.hpp"
#include "engine/forces/bending.hpp"
#include "engine/forces/body_force.hpp"
#include "engine/forces/contact_traction.hpp"
#include "engine/forces/contact_variational.hpp"
#include "engine/forces/in_plane_elasticity.hpp"
#include "engine/friction/cortex_viscosity.hpp"

#include <algorithm>

namespace spheroscope::test {
namespace {

constexpr std::uint32_t k_test_stream = 91;

Vec3 normal_vector(const Random& random, std::uint64_t index) {
    return {random.normal(index, 0), random.normal(index, 1), random.normal(index, 2)};
}

}  // namespace

SystemParts make_parts(const PartValues& v) {
    SystemParts parts;
    const auto add = [&](auto term) {
        const auto* raw = term.get();
        parts.terms.push_back(std::move(term));
        return raw;
    };
    const Loc loc{"made_up.toml", 7, 1};
    if (v.E_kPa)
        add(std::make_unique<InPlaneElasticity>(
            loc, InPlaneElasticityParameters{*v.E_kPa, k_thickness_um}));
    if (v.bending)
        add(std::make_unique<Bending>(
            loc, BendingParameters{.E_kPa = v.E_kPa.value(), .thickness_um = k_thickness_um}));
    if (v.gamma_nN_per_um)
        add(std::make_unique<ActiveTension>(loc, ActiveTensionParameters{*v.gamma_nN_per_um}));
    if (v.K_kPa)
        parts.cytosol = add(std::make_unique<CytosolPressure>(
            loc, CytosolPressureParameters{*v.K_kPa, v.T_I_s, v.T_d_s, v.extra_pressure_kPa,
                                           v.gamma_nN_per_um.value_or(0.0), v.exact_volume}));
    if (!v.body_force_nN.isZero())
        add(std::make_unique<BodyForce>(loc, BodyForceParameters{v.body_force_nN, false}));
    parts.frictions.eta_f_kPa_s = v.eta_f_kPa_s;
    if (v.eta_kPa_s > 0.0)
        parts.frictions.edge_nN_s_per_um = edge_friction_nN_s_per_um(v.eta_kPa_s, k_thickness_um);
    if (v.contact) {
        parts.contact = v.contact;
        if (v.contact->form == ContactForm::variational)
            add(std::make_unique<ContactVariational>(loc));
        else
            add(std::make_unique<ContactTraction>(loc));
        parts.frictions.contact = v.contact_friction;
    }
    return parts;
}

PartValues case_a_values() {
    PartValues v;
    v.E_kPa = 20.0;
    v.bending = true;
    v.gamma_nN_per_um = 0.5;
    v.K_kPa = 5.0;
    v.eta_kPa_s = 1.0;
    v.contact = adhesive_law(0.5, 0.3, 2.0, 0.0);
    v.contact_friction = ContactFriction{0.05, 0.05};
    return v;
}

std::vector<double> springs_nN_per_um(const Model& model, double E_kPa) {
    std::vector<double> springs;
    for (std::size_t e = 0; e < model.topology->edges.size(); ++e) {
        const MeshTopology::Edge& edge = model.topology->edges[e];
        springs.push_back(k_spring_nN_per_um(
            E_kPa, k_thickness_um, model.unit_triangle_area[static_cast<std::size_t>(edge.left)],
            model.unit_triangle_area[static_cast<std::size_t>(edge.right)],
            model.unit_edge_length[e]));
    }
    return springs;
}

Model model_with_nodes_on_sphere(int n_nodes, double R_um) {
    auto mesh = std::make_shared<MeshTopology>(*make_icosphere(n_nodes));
    for (Vec3& x : mesh->unit_shape) x.normalize();
    Model model = make_model(mesh, {R_um});
    std::vector<Vec3> x_um;
    for (const Vec3& x : mesh->unit_shape) x_um.push_back(R_um * x);
    model.target_volume_um3 = {enclosed_volume(mesh->triangles, x_um)};
    return model;
}

std::vector<Vec3> turned_cells(const Model& model, std::span<const Vec3> centres_um,
                               std::uint64_t seed, double noise_um) {
    const Random random(seed, k_test_stream);
    std::vector<Vec3> x_um(model.n_all_nodes());
    for (int cell = 0; cell < model.n_cells(); ++cell) {
        const auto c = static_cast<std::size_t>(cell);
        const Vec3 axis = normal_vector(random, c).normalized();
        const Mat3 turn = Eigen::AngleAxisd(6.0 * random.uniform(c, 3), axis).toRotationMatrix();
        const std::span<Vec3> x = model.cell_nodes(std::span<Vec3>(x_um), cell);
        for (std::size_t i = 0; i < x.size(); ++i)
            x[i] = centres_um[c] + model.radius_um[c] * (turn * model.topology->unit_shape[i]) +
                   noise_um * normal_vector(random, 1000 + c * x.size() + i);
    }
    return x_um;
}

Cluster make_cluster(int n_nodes, std::uint64_t seed, double overlap_um, double noise_um) {
    const std::vector<double> radius_um{5.0, 5.5, 6.0, 5.2};
    const double side_um = 2.0 * 5.4 - overlap_um;  // a tetrahedron
    const double s = side_um / std::sqrt(8.0);
    const std::vector<Vec3> centres_um{{s, s, s}, {s, -s, -s}, {-s, s, -s}, {-s, -s, s}};
    Cluster cluster{make_model(make_icosphere(n_nodes), radius_um), {}};
    cluster.x_um = turned_cells(cluster.model, centres_um, seed, noise_um);
    return cluster;
}

Cluster make_doublet(int n_nodes, std::uint64_t seed, double R0_um, double R1_um, double overlap_um,
                     double noise_um) {
    Cluster doublet{make_model(make_icosphere(n_nodes), {R0_um, R1_um}), {}};
    const std::vector<Vec3> centres_um{Vec3::Zero(), Vec3(0.0, 0.0, R0_um + R1_um - overlap_um)};
    doublet.x_um = turned_cells(doublet.model, centres_um, seed, noise_um);
    return doublet;
}

State state_at(const Model& model, std::vector<Vec3> x_um) {
    State state;
    state.x_um = std::move(x_um);
    state.v_um_per_s.assign(model.n_all_nodes(), Vec3::Zero());
    state.volume_integral_s.assign(model.radius_um.size(), 0.0);
    return state;
}

Geometry geometry_of(const Model& model, std::span<const Vec3> x_um, Need needs) {
    Geometry geometry;
    geometry.allocate(model, needs);
    for (int cell = 0; cell < model.n_cells(); ++cell)
        geometry.compute_cell(model, x_um, needs, cell);
    return geometry;
}

StepOutcome advance_until(Method& method, System& system, State& state, double time_s) {
    StepOutcome outcome;
    do outcome = method.advance(system, state, time_s, false);
    while (outcome.accepted && state.time_s < time_s);
    return outcome;
}

}  // namespace spheroscope::test
