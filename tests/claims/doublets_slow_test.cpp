// Two cells stick together: angle, contact area and pressure at rest, on three meshes.
//
// A doublet on a mesh has many states of rest: the rim of the contact catches on nodes and edges,
// and where it stops depends on how the two meshes happen to be turned. So a mesh level is a mean
// over seeds with a scatter, and is compared as such: within 1 %, plus three standard errors of the
// seeds that run here. scenes/claims/README.md has the table and how it was made.

#include "engine/forces/in_plane_elasticity.hpp"
#include "tests/claims/doublet_shape.hpp"
#include "tests/claims/scene_run.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <iostream>

namespace spheroscope::test {
namespace {

/// Mean over seeds, and the scatter of one seed (standard deviation).
struct Recorded {
    double mean, scatter;
};

struct Level {
    int nodes, n_seeds;  ///< seeds that run here
    Recorded cos_theta, clip_area_um2, pressure_kPa;
};

struct Reading {
    const char* name;
    const char* scene;
    std::array<Level, 3> levels;
};

// 8 seeds at 162 and 642 nodes, 4 at 2562.
const std::array k_readings{
    Reading{"printed",
            "claims/doublet_i.toml",
            {Level{162, 3, {0.8564, 0.0046}, {79.5, 1.6}, {0.11597, 0.00027}},
             Level{642, 3, {0.8366, 0.0023}, {93.1, 1.0}, {0.11721, 0.00017}},
             Level{2562, 1, {0.8227, 0.0044}, {102.0, 2.2}, {0.11818, 0.00031}}}},
    Reading{"text",
            "claims/doublet_ii.toml",
            {Level{162, 3, {0.7284, 0.0180}, {136.0, 7.5}, {0.12458, 0.00180}},
             Level{642, 3, {0.7288, 0.0045}, {141.6, 2.1}, {0.12452, 0.00043}},
             Level{2562, 1, {0.7413, 0.0009}, {138.4, 0.5}, {0.12332, 0.00007}}}},
    Reading{"two_sided",
            "claims/doublet_iii.toml",
            {Level{162, 3, {0.7600, 0.0268}, {120.3, 12.0}, {0.12367, 0.00276}},
             Level{642, 3, {0.7381, 0.0098}, {135.6, 4.2}, {0.12585, 0.00104}},
             Level{2562, 1, {0.7343, 0.0009}, {140.1, 0.4}, {0.12618, 0.00009}}}},
};

/// sigma_h = -P + (2 gamma A + sum k (d - d*) d) / 3V from the shape of a cell alone.
double stress_from_shape_kPa(const SceneRun& run, std::size_t cell) {
    const MeshTopology& mesh = *run.last().header->topology;
    const double R_um = double{run.last().header->radius_um[cell]};
    const auto n = static_cast<std::size_t>(mesh.n_nodes());
    const auto x_um = [&](int i) {
        const std::size_t at = 3 * (cell * n + static_cast<std::size_t>(i));
        const auto& x = run.last().x_um;
        return Vec3(double{x[at]}, double{x[at + 1]}, double{x[at + 2]});
    };
    const auto rest_um = [&](int i) -> Vec3 {
        return R_um * mesh.unit_shape[static_cast<std::size_t>(i)];
    };
    const auto area_um2 = [&](int triangle, const auto& position) {
        const auto& [i, j, k] = mesh.triangles[static_cast<std::size_t>(triangle)];
        return 0.5 * (position(j) - position(i)).cross(position(k) - position(i)).norm();
    };
    double virial = 0.0;
    for (int t = 0; t < mesh.n_triangles(); ++t)
        virial += 2.0 * run.scene.cortex.tension->gamma_nN_per_um * area_um2(t, x_um);
    for (const MeshTopology::Edge& e : mesh.edges) {
        const double d_um = (x_um(e.j) - x_um(e.i)).norm();
        const double d_rest_um = (rest_um(e.j) - rest_um(e.i)).norm();
        const double k =
            k_spring_nN_per_um(run.scene.cortex.elastic->E_kPa, run.scene.cortex.thickness_um,
                               area_um2(e.left, rest_um), area_um2(e.right, rest_um), d_rest_um);
        virial += k * (d_um - d_rest_um) * d_um;
    }
    return -double{run.last().pressure_kPa[cell]} +
           virial / (3.0 * double{run.last().volume_um3[cell]});
}

/// The contact forces of each cell balance what is inside, and the two cells balance each other.
void expect_balanced_stresses(const SceneRun& run) {
    const Snapshot& last = run.last();
    std::size_t row = 0;
    while (last.header->fields.at(row)->name != "sigma_h") ++row;
    const double laplace_kPa =
        2.0 * run.scene.cortex.tension->gamma_nN_per_um / double{last.header->radius_um[0]};
    double sigma2 = 0.0;
    for (std::size_t cell = 0; cell < 2; ++cell) {
        const double sigma_h = double{last.fields[row][cell]};
        sigma2 += sigma_h * sigma_h / 2.0;
        EXPECT_NEAR(sigma_h, stress_from_shape_kPa(run, cell), 0.01 * laplace_kPa);
    }
    EXPECT_LT(last.totals.virial_identity * std::sqrt(sigma2), 0.01 * laplace_kPa);
    // What is left of the mean is the residual force of a rim that still creeps.
    EXPECT_NEAR(last.totals.sigma_h_mean_kPa, 0.0, 1e-3 * laplace_kPa);
}

struct Means {
    double cos_theta = 0.0, clip_area_um2 = 0.0, disc_area_um2 = 0.0, pressure_kPa = 0.0;
};

Means run_level(const Reading& reading, const Level& level) {
    Means means;
    for (int seed = 1; seed <= level.n_seeds; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const SceneRun run = run_scene(reading.scene, {{"cells.nodes", std::to_string(level.nodes)},
                                                       {"scene.seed", std::to_string(seed)}});
        EXPECT_EQ(run.result.verdict, RunVerdict::finished) << run.result.message;
        expect_balanced_stresses(run);
        const DoubletShape shape = doublet_shape(run.last());
        means.cos_theta += shape.cos_theta / level.n_seeds;
        means.clip_area_um2 += shape.clip_area_um2 / level.n_seeds;
        means.disc_area_um2 += shape.disc_area_um2 / level.n_seeds;
        means.pressure_kPa += run.last().totals.mean_pressure_kPa / level.n_seeds;
    }
    std::cout << reading.name << ", " << level.nodes << " nodes, " << level.n_seeds
              << " seeds: cos theta " << means.cos_theta << ", clip area " << means.clip_area_um2
              << " um^2, disc " << means.disc_area_um2 << " um^2, pressure " << means.pressure_kPa
              << " kPa\n";
    return means;
}

void expect_recorded(const char* what, double measured, const Recorded& recorded, int n_seeds) {
    EXPECT_NEAR(measured, recorded.mean,
                0.01 * recorded.mean + 3.0 * recorded.scatter / std::sqrt(n_seeds))
        << what;
}

class Doublet : public testing::TestWithParam<Reading> {};

TEST_P(Doublet, RestsAtTheRecordedAngleAreaAndPressureAndTheFinestMeshIsNearItsLimit) {
    std::array<Means, 3> means;
    for (std::size_t k = 0; k < means.size(); ++k) {
        const Level& level = GetParam().levels[k];
        SCOPED_TRACE(std::to_string(level.nodes) + " nodes");
        means[k] = run_level(GetParam(), level);
        expect_recorded("cos theta", means[k].cos_theta, level.cos_theta, level.n_seeds);
        expect_recorded("clip area, um^2", means[k].clip_area_um2, level.clip_area_um2,
                        level.n_seeds);
        expect_recorded("pressure, kPa", means[k].pressure_kPa, level.pressure_kPa, level.n_seeds);
        // The clip area has the strip around the disc in which the gap is still below 2 h0.
        EXPECT_GT(means[k].clip_area_um2, means[k].disc_area_um2);
    }
    // Richardson, second order in the edge length: v + (v - v of twice the edge) / 3.
    const auto limit = [&](double Means::*member) {
        return means[2].*member + (means[2].*member - means[1].*member) / 3.0;
    };
    EXPECT_NEAR(means[2].cos_theta / limit(&Means::cos_theta), 1.0, 0.01);
    EXPECT_NEAR(means[2].pressure_kPa / limit(&Means::pressure_kPa), 1.0, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Readings, Doublet, testing::ValuesIn(k_readings),
                         [](const auto& reading) { return std::string(reading.param.name); });

TEST(MirrorImages, RestOnASmallerContactThanCellsThatAreTurned) {
    const std::string turned = scene_text("claims/doublet_ii.toml");
    const std::string pair = "arrangement = \"pair\"\nradius = 9\ngap = 0.2\n";
    const auto from = turned.find("arrangement"), to = turned.find("[cortex.elastic]");
    ASSERT_LT(from, to);
    const std::string mirrored =
        std::string(turned).replace(from, to - from, pair + "nodes = 162\n\n");
    const SceneRun on_saddle =
        run_scene(scene::parse_scene(mirrored, "mirrored.toml", {{"stage[0].duration", "20"}}));
    const SceneRun settled =
        run_scene("claims/doublet_ii.toml", {{"cells.nodes", "162"}, {"stage[0].duration", "50"}});
    // At rest by its velocities, and yet a fifth of the contact is missing: until round-off, some
    // 30 s later, takes the pair off the saddle.
    EXPECT_LT(on_saddle.last().totals.normal_speed_rms_um_per_s, 1e-3);
    EXPECT_LT(on_saddle.last().totals.contact_area_um2,
              0.85 * settled.last().totals.contact_area_um2);
}

}  // namespace
}  // namespace spheroscope::test
