// What statistics see of a run is what the run itself measured.
#include "engine/statistics/aggregate.hpp"
#include "engine/statistics/coordination.hpp"
#include "engine/statistics/setup.hpp"
#include "tests/inspect/small_runs.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace spheroscope::statistics {
namespace {

const char* const k_scene = R"(
[scene]
title = "Three cells"
seed = 7
[cells]
arrangement = "centres"
nodes = 42
centres = [[0, 0, 0, 9], [0, 17, 0, 9], [15, 8, 0, 9]]
[cortex.elastic]
E = "20 kPa"
[cortex.bending]
[cortex.tension]
gamma = "0.5 nN/um"
[cortex.viscosity]
eta = "1 kPa s"
[cytosol]
K = "5 kPa"
[medium]
[contact]
law = "traction"
[contact.adhesion]
omega = "0.25 nN/um"
[contact.friction]
normal = "0.05 kPa s/um"
tangential = "0.05 kPa s/um"
[method]
dt_max = "0.05 s"
[[stage]]
kind = "relax"
duration = 0.3
[measures]
fields = ["sigma_h", "sigma_nn", "shear", "gamma_eff", "anisotropic_max"]
)";

Aggregate aggregate_of_frame(const SnapshotPtr& frame) {
    inspect::FrameSystem system(frame->header, {}, inspect::FrameSystem::Detail::contacts);
    system.load(frame);
    return aggregate_of(system);
}

TEST(AggregateOfAFrame, HasTheFieldsThatTheRunWrote) {
    const test::SmallRun run = test::run_scene_text(k_scene);
    const Aggregate aggregate = aggregate_of_frame(run.last());
    const std::vector<const std::vector<double>*> fields{
        &aggregate.sigma_h_kPa, &aggregate.sigma_nn_kPa, &aggregate.shear_kPa,
        &aggregate.gamma_eff_nN_per_um, &aggregate.anisotropic_max_kPa};
    for (std::size_t f = 0; f < fields.size(); ++f) {
        const std::vector<float>& stored = run.last()->fields[f];
        ASSERT_EQ(stored.size(), fields[f]->size()) << run.header->fields[f]->name;
        double size = 0.0, difference = 0.0;
        for (std::size_t i = 0; i < stored.size(); ++i) {
            EXPECT_EQ(std::isnan(stored[i]), std::isnan((*fields[f])[i]));
            if (std::isnan(stored[i])) continue;
            size = std::max(size, std::abs(double{stored[i]}));
            difference = std::max(difference, std::abs(double{stored[i]} - (*fields[f])[i]));
        }
        EXPECT_GT(size, 0.0);
        EXPECT_LT(difference, 1e-3 * size) << run.header->fields[f]->name;
    }
    EXPECT_NEAR(aggregate.R_th_um, run.last()->totals.R_th_um, 1e-4);
    EXPECT_DOUBLE_EQ(coordination(aggregate.pairs, 3, aggregate.touching_area_um2),
                     run.last()->totals.coordination_Z);
}

TEST(SetupOfARun, IsTheSameForAnotherSeedAndNoOther) {
    const test::SmallRun run = test::run_scene_text(k_scene);
    const auto with = [&](const std::string& key, const std::string& value) {
        RunHeader header = *run.header;
        header.resolved_scene =
            scene::parse_scene(run.header->resolved_scene, "x", {{key, value}}).resolved_toml;
        return setup_of(header);
    };
    const auto setup = setup_of(*run.header);
    EXPECT_EQ(with("scene.seed", "8").scene_without_seed, setup.scene_without_seed);
    EXPECT_NE(with("cortex.elastic.E", "21").scene_without_seed, setup.scene_without_seed);
    // What cells felt on the way makes another set-up, colours do not.
    const std::vector<Change> tension{{1.5, "cortex.tension.gamma", {0.7}}},
        colours{{1.5, "picture.given_range", {0.0, 1.0}}};
    EXPECT_NE(setup_of(*run.header, tension).scene_without_seed, setup.scene_without_seed);
    EXPECT_EQ(setup_of(*run.header, tension).changes, changes_text(tension));
    EXPECT_EQ(setup_of(*run.header, colours).scene_without_seed, setup.scene_without_seed);
    EXPECT_EQ(setup.title, "Three cells");
    EXPECT_DOUBLE_EQ(setup.gamma_over_omega, 2.0);
    EXPECT_DOUBLE_EQ(setup.Et_over_omega, 16.0);
    EXPECT_EQ(setup.n_cells, 3);
    EXPECT_EQ(setup.n_nodes, 42);
    EXPECT_EQ(setup.law, "traction");
    EXPECT_TRUE(setup.is_in_table_2());
    EXPECT_TRUE(setup.is_in_table_2(setup.gamma_over_omega, setup.Et_over_omega));
    EXPECT_FALSE(setup.is_in_table_2(8.0, 0.125));
    EXPECT_FALSE(with("cortex.elastic.E", "0.039").is_in_table_2());
}

TEST(RatioText, WritesPartsOfOneAsThePaperDoes) {
    EXPECT_EQ(ratio_text(0.125), "1/8");
    EXPECT_EQ(ratio_text(8.0), "8");
    EXPECT_EQ(ratio_text(0.75), "0.75");
    EXPECT_EQ(ratio_text(1.0), "1");
}

}  // namespace
}  // namespace spheroscope::statistics
