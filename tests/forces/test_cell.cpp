#include "tests/forces/test_cell.hpp"

#include "engine/base/random.hpp"
#include "engine/forces/active_tension.hpp"
#include "engine/forces/bending.hpp"
#include "engine/forces/body_force.hpp"
#include "engine/forces/compaction_wall.hpp"
#include "engine/forces/confining_hull.hpp"
#include "engine/forces/cytosol_pressure.hpp"
#include "engine/forces/fold_stop.hpp"
#include "engine/forces/held_force.hpp"
#include "engine/forces/in_plane_elasticity.hpp"
#include "engine/forces/indenting_probe.hpp"
#include "engine/forces/strain_limiter.hpp"
#include "engine/forces/terms.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace spheroscope::test {
namespace {
constexpr Need k_all_needs = Need::triangles | Need::volumes;

/// One for each node of the largest test cells; smaller ones read the first of them.
std::vector<Vec3> held_forces_nN() {
    const Random random(1, 78);
    std::vector<Vec3> force_nN;
    for (std::uint64_t i = 0; i < 2 * 2562; ++i)
        force_nN.emplace_back(random.normal(i, 0), random.normal(i, 1), 1.0 + random.normal(i, 2));
    return force_nN;
}
}  // namespace

TestCell::TestCell(int n_nodes, double R_um)
    : model(make_model(make_icosphere(n_nodes), {7.0, R_um}, 0.01)) {
    for (const double R : model.radius_um)
        for (const Vec3& x : model.topology->unit_shape) x_um.push_back(R * x);
    contacts.clear(model.n_cells());
    geometry.allocate(model, k_all_needs);
    for (int c = 0; c < model.n_cells(); ++c) geometry.compute_cell(model, x_um, k_all_needs, c);
}

void TestCell::shake(std::uint64_t seed, double noise) {
    const double mean_edge =
        std::accumulate(model.unit_edge_length.begin(), model.unit_edge_length.end(), 0.0) /
        static_cast<double>(model.unit_edge_length.size());
    const Random random(seed, 77);
    const double R = model.radius_um[cell];
    for (std::size_t i = 0; i < n_nodes(); ++i) {
        const Vec3 r(random.normal(i, 0), random.normal(i, 1), random.normal(i, 2));
        x()[i] = R * (model.topology->unit_shape[i] + noise * mean_edge * r);
    }
    update();
}

void TestCell::update() { geometry.compute_cell(model, x_um, k_all_needs, cell); }

std::span<Vec3> TestCell::x() { return model.cell_nodes(std::span<Vec3>(x_um), cell); }

Configuration TestCell::at() const {
    return {model, x_um, volume_integral_s, geometry, contacts, wall_radius_um, load};
}

Load TestCell::made_up_load() {
    Hull hull;
    hull.planes = {{Vec3(1.0, 0.2, 0.0).normalized(), 8.3},
                   {Vec3(-0.3, 1.0, 0.4).normalized(), 8.5},
                   {Vec3(0.1, -0.2, -1.0).normalized(), 7.9}};
    Load result;
    result.hull = std::make_shared<const Hull>(std::move(hull));
    result.probe = {.radius_um = 27.0,
                    .force_nN = 15.0,
                    .friction_nN_s_per_um = 25.4,
                    .start_um = Vec3(1.0, -2.0, 34.5),
                    .direction = Vec3(0.0, 0.0, -1.0),
                    .way_um = 0.7};
    return result;
}

std::vector<Vec3> TestCell::force_nN(const ForceTerm& term) const {
    std::vector<Vec3> F(n_nodes(), Vec3::Zero());
    term.add_force(at(), cell, F);
    return F;
}

double TestCell::energy_fJ(const ForceTerm& term) const {
    return term.energy_fJ(at(), cell).value();
}

std::vector<std::unique_ptr<ForceTerm>> make_all_terms() {
    std::vector<std::unique_ptr<ForceTerm>> terms;
    terms.push_back(std::make_unique<InPlaneElasticity>(
        Loc{}, InPlaneElasticityParameters{.E_kPa = 20.0, .thickness_um = 0.2}));
    terms.push_back(
        std::make_unique<Bending>(Loc{}, BendingParameters{.E_kPa = 20.0, .thickness_um = 0.2}));
    terms.push_back(std::make_unique<ActiveTension>(Loc{}, ActiveTensionParameters{0.5}));
    terms.push_back(std::make_unique<CytosolPressure>(
        Loc{}, CytosolPressureParameters{.K_kPa = 5.0,
                                         .T_I_s = 0.8,
                                         .T_d_s = 0.1,
                                         .extra_pressure_kPa = 0.03,
                                         .gamma_nN_per_um = 0.5}));
    terms.push_back(std::make_unique<StrainLimiter>(Loc{}, StrainLimiterParameters{0.25, 0.02}));
    terms.push_back(std::make_unique<FoldStop>(Loc{}, FoldStopParameters{0.25, 0.3}));
    terms.push_back(std::make_unique<CompactionWall>(Loc{}, CompactionWallParameters{50.0}));
    terms.push_back(std::make_unique<ConfiningHull>(Loc{}, ConfiningHullParameters{50.0}));
    terms.push_back(std::make_unique<IndentingProbe>(Loc{}, IndentingProbeParameters{50.0}));
    terms.push_back(
        std::make_unique<BodyForce>(Loc{}, BodyForceParameters{{1.0, -2.0, 0.5}, true}));
    terms.push_back(std::make_unique<HeldForce>(Loc{}, held_forces_nN()));
    return terms;
}

std::unique_ptr<ForceTerm> make_term(std::size_t row) { return std::move(make_all_terms()[row]); }

std::string name_of_row(const testing::TestParamInfo<std::size_t>& tested) {
    std::string name(force_terms()[tested.param].name);
    std::replace(name.begin(), name.end(), '.', '_');
    return name;
}

double norm(const std::vector<Vec3>& values) {
    double sum = 0.0;
    for (const Vec3& v : values) sum += v.squaredNorm();
    return std::sqrt(sum);
}

double distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]).squaredNorm();
    return std::sqrt(sum);
}

}  // namespace spheroscope::test
