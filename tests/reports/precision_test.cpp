#include "engine/reports/mesh_ladder.hpp"
#include "tests/reports/stretched_cell.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace spheroscope::reports {
namespace {

scene::Scene stretched_cell() {
    return scene::parse_scene(
        stretched_cell_text("0.064 s", "dt = \"2 ms\"\nlinear_tolerance = 1e-9\n"),
        "stretched.toml");
}

TEST(Precision, ErrorsOfFixedStepsFallWithTheDeclaredOrderOfTheMethod) {
    const Precision precision = compute_precision(stretched_cell(), {.n_levels = 4});
    ASSERT_TRUE(precision.reference);
    int n_compared = 0;
    for (std::size_t r = 1; r < precision.rows.size(); ++r) {
        const PrecisionRow &coarse = precision.rows[r - 1], &fine = precision.rows[r];
        if (coarse.setting.method != fine.setting.method || !fine.setting.is_fixed()) continue;
        ASSERT_FALSE(coarse.errors.empty() || fine.errors.empty());
        if (!precision.is_resolved(fine, 0)) continue;
        // terms of the next order, and up to 10 % of the error from the reference
        EXPECT_NEAR(std::log2(coarse.errors[0] / fine.errors[0]), fine.setting.method->order, 0.2)
            << fine.setting.text();
        ++n_compared;
    }
    EXPECT_GE(n_compared, 3);
}

TEST(Precision, EveryMethodThatMovesInTimeIsInIt) {
    const Precision precision = compute_precision(stretched_cell(), {.n_levels = 1});
    std::size_t n = 0;
    for (const MethodRow& method : all_methods()) {
        if (!method.moves_in_time()) continue;
        ASSERT_LT(n, precision.rows.size());
        EXPECT_EQ(precision.rows[n++].setting.method, &method);
    }
    EXPECT_EQ(n, precision.rows.size());
    EXPECT_LT(n, all_methods().size());
}

TEST(Precision, AMethodThatFailsIsShownAsFailedAndHasNoErrors) {
    scene::Scene scene = stretched_cell();
    scene.cortex.elastic->E_kPa = 2000.0;
    scene.method.dt_s = 0.016;
    const Precision precision = compute_precision(scene, {.n_levels = 1});
    const PrecisionRow* explicit_row = nullptr;
    for (const PrecisionRow& row : precision.rows)
        if (row.setting.method->name == "forward_euler") explicit_row = &row;
    ASSERT_NE(explicit_row, nullptr);
    EXPECT_FALSE(explicit_row->run.is_complete());
    EXPECT_TRUE(explicit_row->errors.empty());
    EXPECT_NE(explicit_row->run.message, "");
}

TEST(Precision, TimesOfShortRunsAreTheLeastOfSeveral) {
    PrecisionOptions options{.n_levels = 1, .most_reference_halvings = 1};
    options.repetitions = {.most = 3, .longest_s = 60.0};
    for (const PrecisionRow& row : compute_precision(stretched_cell(), options).rows)
        EXPECT_EQ(row.n_runs, 3);
    options.repetitions.longest_s = 0.0;
    for (const PrecisionRow& row : compute_precision(stretched_cell(), options).rows)
        EXPECT_EQ(row.n_runs, 1) << "what takes long is not repeated";
}

TEST(Precision, AReferenceThatIsTooCoarseHidesWhatItCannotTell) {
    PrecisionOptions options{.n_levels = 3};
    options.most_reference_halvings = 1;
    const Precision precision = compute_precision(stretched_cell(), options);
    ASSERT_TRUE(precision.reference);
    EXPECT_FALSE(precision.reference_is_fine_enough());
    int n_hidden = 0;
    for (const PrecisionRow& row : precision.rows)
        if (!row.errors.empty() && !precision.is_resolved(row, 0)) ++n_hidden;
    EXPECT_GT(n_hidden, 0);
}

/// Two cells that stick together; `law_keys` are lines of [contact].
scene::Scene doublet(const std::string& law_keys) {
    return scene::parse_scene(R"([cells]
arrangement = "centres"
nodes = 42
centres = [[0, 0, -8.9, 9], [0, 0, 8.9, 9]]
)" + k_case_a_cell + case_a_contact(law_keys) +
                                  R"([method]
dt = "4 ms"
[[stage]]
kind = "relax"
duration = "0.064 s"
)",
                              "doublet.toml");
}

TEST(Precision, SaysWhatSinglePrecisionOfTheKernelCosts) {
    const Precision precision = compute_precision(doublet(""), {.n_levels = 1});
    ASSERT_TRUE(precision.reference);
    ASSERT_EQ(precision.cost_of_floats.size(), all_error_measures().size());
    for (std::size_t m = 0; m < all_error_measures().size(); ++m) {
        const std::string_view name = all_error_measures()[m].name;
        const double change = precision.cost_of_floats[m];
        if (name == "positions" || name == "contact_area") {
            EXPECT_GT(change, 0.0) << name;
        }
        // nodal forces are exact to 2e-6, and the motion is stable
        if (!std::isnan(change)) {
            EXPECT_LT(change, 1e-4) << name;
        }
    }
}

TEST(Precision, ComparesNothingWithDoublesWhereTheKernelIsNotInFloats) {
    const PrecisionOptions options{.n_levels = 1, .most_reference_halvings = 1};
    EXPECT_TRUE(
        compute_precision(doublet("precision = \"double\"\n"), options).cost_of_floats.empty());
    EXPECT_TRUE(
        compute_precision(doublet("law = \"variational\"\n"), options).cost_of_floats.empty());
    EXPECT_TRUE(compute_precision(stretched_cell(), options).cost_of_floats.empty());
}

TEST(Precision, ScenesWhoseTimesDependOnTheMethodAreRefused) {
    scene::Scene scene = stretched_cell();
    scene.stages[0].until = scene::Until::rest;
    EXPECT_THROW(static_cast<void>(compute_precision(scene, {})), Error);
}

TEST(MeasuredRun, SamplesLieAtTheSameTimesForEveryMethod) {
    const scene::Scene fixed = with_fixed_outputs(stretched_cell(), 8);
    for (const MethodRow& method : all_methods()) {
        if (!method.moves_in_time()) continue;
        MethodSetting setting = own_setting(fixed);
        setting.method = &method;
        const MeasuredRun run = measure_run(setting.applied_to(fixed), {});
        ASSERT_TRUE(run.is_complete()) << method.name << ": " << run.message;
        ASSERT_EQ(run.samples.size(), 8U) << method.name;
        for (std::size_t k = 0; k < 8; ++k)
            EXPECT_NEAR(run.samples[k].time_s, 0.008 * static_cast<double>(k + 1), 1e-15);
    }
}

TEST(MeshLadder, TellsMeshErrorFromTimeError) {
    scene::Scene scene = stretched_cell();
    const MeshLadder ladder = compute_mesh_ladder(scene, 642, {});
    ASSERT_EQ(ladder.levels.size(), 3U);
    ASSERT_EQ(ladder.results.size(), all_mesh_measures().size());
    for (const MeshLevel& level : ladder.levels) EXPECT_TRUE(level.run.is_complete());
    int n_resolved = 0;
    for (const MeshResult& result : ladder.results)
        if (result.extrapolation.is_resolved) {
            ++n_resolved;
            EXPECT_TRUE(std::isfinite(result.mesh_error));
        }
    EXPECT_GT(n_resolved, 0);
}

/// Which error the ladder finds larger in the surface tension, of forward Euler on 642 nodes.
std::string_view dominant_in_gamma_eff(double dt_s) {
    scene::Scene scene = scene::on_mesh(stretched_cell(), 642);
    scene.method.name = "forward_euler";
    scene.method.dt_s = dt_s;
    const MeshLadder ladder = compute_mesh_ladder(scene, 642, {});
    for (std::size_t m = 0; m < ladder.results.size(); ++m)
        if (all_mesh_measures()[m].name == "gamma_eff_rms") return ladder.results[m].dominant();
    return "not there";
}

TEST(MeshLadder, BlamesLongStepsAndThenTheMesh) {
    EXPECT_EQ(dominant_in_gamma_eff(8e-3), "time");  // 10 % against 1.8 %
    EXPECT_EQ(dominant_in_gamma_eff(1e-3), "mesh");  // 1.2 %
}

TEST(MeshLadder, WithoutALimitComparesWithTheFinestLevelAndSaysSo) {
    const MeshLadder ladder = compute_mesh_ladder(stretched_cell(), 162, {});
    ASSERT_EQ(ladder.levels.size(), 2U);
    int n_known = 0;
    for (const MeshResult& result : ladder.results) {
        EXPECT_FALSE(result.extrapolation.is_resolved);
        if (std::isnan(result.values[0])) continue;
        ++n_known;
        EXPECT_TRUE(result.mesh_error_is_rough);
        EXPECT_DOUBLE_EQ(result.mesh_error, std::abs(result.values[0] / result.values[1] - 1.0));
        EXPECT_NE(result.dominant(), "unknown");
    }
    EXPECT_GT(n_known, 0);
    // of a scene on its finest level nothing is known
    for (const MeshResult& result : compute_mesh_ladder(stretched_cell(), 42, {}).results)
        EXPECT_EQ(result.dominant(), "unknown");
}

TEST(MeshLadder, TakesStepsBelowTheLeastOfTheScene) {
    scene::Scene scene = stretched_cell();
    scene.method.dt_min_s = scene.method.dt_s;
    const MeshLadder ladder = compute_mesh_ladder(scene, 42, {});
    EXPECT_TRUE(ladder.own_run.run.is_complete()) << ladder.own_run.run.message;
    EXPECT_TRUE(ladder.finer_run.run.is_complete()) << ladder.finer_run.run.message;
    EXPECT_GT(ladder.finer_run.run.work.steps, ladder.own_run.run.work.steps);
}

}  // namespace
}  // namespace spheroscope::reports
