// The errors that a run says it has meet the true ones, on the motions of scenes/bench in full
// length: that of the time steps, for each method at three settings, against a far finer run on the
// same mesh; that of the mesh against the limit extrapolated from the finest meshes that are
// affordable. The tables that this prints are in engine/README.md, 'How wrong', and so is what is
// let off here.
#include "engine/run/companion.hpp"
#include "engine/run/engine.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <string_view>
#include <vector>

namespace spheroscope {
namespace {

scene::Scene bench(const std::string& name, std::vector<scene::Override> changes) {
    return scene::load_scene(fmt::format("{}/scenes/bench/{}.toml", SPHEROSCOPE_SOURCE_DIR, name),
                             changes);
}

RunResult run(const scene::Scene& scene) {
    Engine engine(scene, EngineOptions{.threads = 1, .version = "", .command_line = ""});
    EngineSinks sinks;
    sinks.frame = [](const SnapshotPtr&) { return std::optional<std::string>(); };
    RunResult result = engine.run(sinks, std::atomic<bool>{false});
    EXPECT_EQ(result.verdict, RunVerdict::finished) << result.message;
    return result;
}

std::map<std::string, double> values_of(const RunResult& result) {
    std::map<std::string, double> values;
    for (const MeasureError& error : result.errors) values[error.measure] = error.value;
    return values;
}

/// What no estimate speaks about: the last digits that are left to the linear solver.
constexpr double k_negligible = 1e-6;
/// What an estimate is good for: true error over estimate.
constexpr double k_least = 0.2, k_most = 3.0;

/// An estimate that is not as good, with the ratio that was measured. The test fails when it has
/// become another one, so that this list stays true.
struct Exemption {
    const char *scene, *setting;
    std::vector<std::string_view> measures;
    double measured;
};

/// Holds the ratio to the bounds, or to twice and half of what the list has for it.
void expect_good(double ratio, const std::vector<Exemption>& exemptions, const std::string& scene,
                 const std::string& setting, const std::string& measure) {
    double least = k_least, most = k_most;
    for (const Exemption& e : exemptions)
        if (scene == e.scene && setting == e.setting &&
            std::ranges::count(e.measures, measure) > 0) {
            least = 0.5 * e.measured;
            most = 2.0 * e.measured;
        }
    EXPECT_GT(ratio, least) << scene << ", " << setting << ", " << measure;
    EXPECT_LT(ratio, most) << scene << ", " << setting << ", " << measure;
}

class EstimateOnBench : public testing::TestWithParam<const char*> {};

TEST_P(EstimateOnBench, OfTheTimeStepsLiesWithinAFactorOfTheTrueError) {
    const std::vector<Exemption> exemptions{
        // Seventeen steps, bounded by how far nodes may move: too few for errors to have an order.
        {"doublet_stiff", "rkc 0.006", {"contact_area", "contact_fraction"}, 5.8},
        // Near the largest stable step the error changes its sign.
        {"stiff_cell", "forward_euler 0.00385", {"energy"}, 0.091},
        // By accident half of the steps changes it little: the contact fraction has 1.2.
        {"aggregate_75", "rkc 0.0004", {"contact_area"}, 3.0},
    };
    const std::string name = GetParam();
    const bool is_large = name == "ball_13" || name == "aggregate_75";
    const scene::Scene exact = bench(name, {{"method.name", "rkc"},
                                            {"method.tolerance", is_large ? "1e-5" : "2e-6"},
                                            {"method.linear_tolerance", "1e-6"}});
    const auto truth = values_of(run(exact));
    struct Setting {
        const char *method, *key, *value;
    };
    for (const Setting& setting : {Setting{"linearly_implicit", "tolerance", "0.006"},
                                   {"linearly_implicit", "tolerance", "0.0015"},
                                   {"linearly_implicit", "tolerance", "0.0004"},
                                   {"rosenbrock_w", "tolerance", "0.006"},
                                   {"rosenbrock_w", "tolerance", "0.0015"},
                                   {"rosenbrock_w", "tolerance", "0.0004"},
                                   {"rkc", "tolerance", "0.006"},
                                   {"rkc", "tolerance", "0.0015"},
                                   {"rkc", "tolerance", "0.0004"},
                                   {"forward_euler", "dt", "0.00385"},
                                   {"forward_euler", "dt", "0.002"},
                                   {"forward_euler", "dt", "0.001"}}) {
        const scene::Scene own =
            bench(name, {{"method.name", setting.method},
                         {std::string("method.") + setting.key, setting.value}});
        RunResult result = run(own);
        for (const MeasureError& error : result.errors)
            EXPECT_TRUE(std::isnan(error.measured())) << "one run knows no error of its own";
        const RunResult finer = run(with_half_steps(own, result.time_s, result.work.steps));
        set_time_error(result.errors, finer.totals, find_method(setting.method)->order);
        std::string line = fmt::format("{:<14} {:<18} {:<8}", name, setting.method, setting.value);
        for (const MeasureError& error : result.errors) {
            const double true_error = std::abs(error.value - truth.at(error.measure));
            const bool is_negligible = true_error < k_negligible * std::abs(error.value);
            const double ratio = true_error / error.time;
            line += fmt::format(" {} {:.2g}{}", error.measure, ratio, is_negligible ? "!" : "");
            if (!is_negligible)
                expect_good(ratio, exemptions, name,
                            fmt::format("{} {}", setting.method, setting.value), error.measure);
        }
        std::cout << line << "\n";
    }
}

class MeshEstimateOnBench : public testing::TestWithParam<const char*> {};

TEST_P(MeshEstimateOnBench, LiesWithinAFactorOfTheTrueErrorOrIsCautious) {
    const std::string name = GetParam();
    const scene::Scene own =
        bench(name, {{"method.name", "rosenbrock_w"}, {"method.tolerance", "0.0015"}});
    std::map<int, RunResult> on;
    for (const int nodes : {42, 162, 642, 2562}) on[nodes] = run(scene::on_mesh(own, nodes));
    const auto fine = values_of(on[642]), finest = values_of(on[2562]);
    const auto compare = [&](int nodes, const std::vector<Totals>& coarser) {
        add_mesh_error(on[nodes].errors, coarser);
        std::string line = fmt::format("{:<14} mesh of {} nodes ", name, nodes);
        for (const MeasureError& error : on[nodes].errors) {
            const double last = finest.at(error.measure);
            const double limit = last + (last - fine.at(error.measure)) / 3.0;
            const double ratio = std::abs(error.value - limit) / error.mesh;
            line += fmt::format(" {} {:.2g}", error.measure, ratio);
            EXPECT_LT(ratio, k_most) << line;
            // On the way from 42 to 642 nodes stresses cross their limit, from 642 to 2562 contact
            // areas do: there the true error is small by accident, and the estimate cannot know.
            const bool may_be_lucky = error.measure.starts_with(nodes == 162 ? "sigma" : "contact");
            if (!may_be_lucky) {
                EXPECT_GT(ratio, k_least) << line;
            }
        }
        std::cout << line << "\n";
    };
    compare(162, {on[42].totals});
    compare(642, {on[162].totals, on[42].totals});
}

INSTANTIATE_TEST_SUITE_P(Scenes, EstimateOnBench,
                         testing::Values("stiff_cell", "doublet_stiff", "doublet_soft", "ball_13",
                                         "aggregate_75"),
                         [](const auto& tested) { return std::string(tested.param); });

// The aggregate would take minutes on 2562 nodes, and on fewer its limit is not known.
INSTANTIATE_TEST_SUITE_P(Scenes, MeshEstimateOnBench,
                         testing::Values("stiff_cell", "doublet_stiff", "doublet_soft", "ball_13"),
                         [](const auto& tested) { return std::string(tested.param); });

}  // namespace
}  // namespace spheroscope
