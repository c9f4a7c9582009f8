// A run that is stopped at any step and goes on from its saved state does what it would have done.
#include "engine/run/engine.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <map>

namespace spheroscope {
namespace {

constexpr const char* k_scene = R"(
[scene]
title = "Four cells through every kind of stage"
seed = 3
[cells]
arrangement = "packing"
count = 4
nodes = 42
[cortex.elastic]
E = "20 kPa"
[cortex.bending]
[cortex.tension]
gamma = "0.5 nN/um"
[cortex.viscosity]
eta = "1 kPa s"
[cytosol]
controller = "pid"
K = "5 kPa"
[medium]
eta_f = "0.05 kPa s"
[contact]
h0 = "0.3 um"
[contact.adhesion]
omega = "0.5 nN/um"
[contact.friction]
normal = "0.05 kPa s/um"
tangential = "0.05 kPa s/um"
[method]
name = "linearly_implicit"
dt_max = "0.1 s"
[[stage]]
kind = "anneal"
packing_fraction = 0.4
steps = 2000
frames = 4
[[stage]]
kind = "compact"
duration = "0.1 s"
every = "0.03 s"
[[stage]]
kind = "hold"
duration = "0.05 s"
every = "0.03 s"
[[stage]]
kind = "release"
duration = "0.05 s"
every = "0.03 s"
[[stage]]
kind = "relax"
until = "rest"
cap = "0.2 s"
every = "0.05 s"
[[stage]]
kind = "indent"
until = "rest"
cap = "0.3 s"
every = "0.1 s"
[measures]
fields = ["sigma_h", "sigma_nn"]
)";

/// For methods that cannot move a probe.
std::string without_indentation() {
    const std::string text = k_scene;
    const std::size_t begin = text.rfind("[[stage]]");
    return text.substr(0, begin) + text.substr(text.find("[measures]"));
}

/// What comes out of a run: its frames, and where it ended.
struct Record {
    std::vector<SnapshotPtr> frames;
    RunResult result;
    std::map<int, int> stops_in_stage;
};

/// Runs the scene to its end in one go, or stops it after every `steps_between_stops` reports,
/// saves its state, and goes on with a new engine from what was saved.
Record run_scene(const scene::Scene& scene, int steps_between_stops) {
    Record record;
    std::optional<CheckpointData> saved;
    do {
        Engine engine(scene, EngineOptions{.threads = 1, .version = "", .command_line = ""});
        if (saved) engine.resume(load_run_state(*saved));
        std::atomic<bool> stop{false};
        int n_reports = 0;
        EngineSinks sinks;
        sinks.frame = [&](SnapshotPtr frame) -> std::optional<std::string> {
            EXPECT_EQ(frame->frame, static_cast<int>(record.frames.size()));
            record.frames.push_back(std::move(frame));
            return std::nullopt;
        };
        sinks.checkpoint = [&](const CheckpointData& data) { saved = data; };
        sinks.progress = [&](const RunProgress& progress) {
            if (steps_between_stops > 0 && ++n_reports == steps_between_stops) {
                ++record.stops_in_stage[progress.stage];
                stop = true;
            }
        };
        record.result = engine.run(sinks, stop);
    } while (record.result.verdict == RunVerdict::stopped);
    return record;
}

bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

void expect_same(const Record& stopped, const Record& whole) {
    EXPECT_EQ(stopped.result.verdict, whole.result.verdict);
    EXPECT_EQ(stopped.result.outcome, whole.result.outcome);
    EXPECT_EQ(stopped.result.state_hash, whole.result.state_hash);
    EXPECT_EQ(stopped.result.work.steps, whole.result.work.steps);
    ASSERT_EQ(stopped.frames.size(), whole.frames.size());
    for (std::size_t i = 0; i < whole.frames.size(); ++i) {
        const Snapshot &a = *stopped.frames[i], &b = *whole.frames[i];
        EXPECT_EQ(a.time_s, b.time_s) << "frame " << i;
        EXPECT_TRUE(same_bits(a.x_um, b.x_um)) << "frame " << i;
        for (std::size_t f = 0; f < b.fields.size(); ++f)
            EXPECT_TRUE(same_bits(a.fields[f], b.fields[f])) << "frame " << i << ", field " << f;
        for (const TotalsRow& row : all_totals()) {
            const double x = value_of(row, a.totals), y = value_of(row, b.totals);
            EXPECT_TRUE(x == y || (x != x && y != y)) << "frame " << i << ", " << row.name;
        }
    }
}

TEST(ResumedEngine, ContinuesToTheBitFromStopsInEveryStage) {
    const scene::Scene scene = scene::parse_scene(k_scene, "scene.toml");
    const Record whole = run_scene(scene, 0);
    ASSERT_EQ(whole.result.verdict, RunVerdict::cap);
    const Record stopped = run_scene(scene, 2);
    for (int stage = 0; stage < 6; ++stage)
        EXPECT_GT(stopped.stops_in_stage.count(stage), 0U) << "stage " << stage;
    expect_same(stopped, whole);
}

TEST(ResumedEngine, ContinuesToTheBitWithThePapersMethod) {
    const scene::Scene scene = scene::parse_scene(
        without_indentation(), "scene.toml",
        {{"method.name", "forward_euler"}, {"method.dt", "0.0005 s"}, {"stage[4].cap", "0.1 s"}});
    const Record whole = run_scene(scene, 0);
    ASSERT_EQ(whole.result.verdict, RunVerdict::cap) << whole.result.message;
    const Record stopped = run_scene(scene, 46);
    EXPECT_GE(stopped.stops_in_stage.size(), 4U);
    expect_same(stopped, whole);
}

TEST(ResumedEngine, ContinuesToTheBitFromACoarseStartToAFineEnd) {
    const scene::Scene scene = scene::parse_scene(without_indentation(), "scene.toml",
                                                  {{"cells.nodes", "162"},
                                                   {"stage[0].nodes", "42"},
                                                   {"stage[1].nodes", "42"},
                                                   {"stage[2].nodes", "42"},
                                                   {"stage[4].cap", "0.1 s"}});
    const Record whole = run_scene(scene, 0);
    ASSERT_EQ(whole.result.verdict, RunVerdict::cap) << whole.result.message;
    for (const SnapshotPtr& frame : whole.frames) {
        EXPECT_EQ(frame->x_um.size(), 4U * 162U * 3U);
        EXPECT_EQ(frame->fields[1].size(), 4U * 320U);  // sigma_nn
        for (std::size_t i = 0; i + 2 < frame->normal.size(); i += 3) {
            const Vec3 normal(double{frame->normal[i]}, double{frame->normal[i + 1]},
                              double{frame->normal[i + 2]});
            EXPECT_NEAR(normal.norm(), 1.0, 1e-5);
        }
    }
    const Record stopped = run_scene(scene, 2);
    EXPECT_GE(stopped.stops_in_stage.size(), 5U);
    expect_same(stopped, whole);
    // Most of the work is done on the coarse mesh, and all of it is counted.
    const Record fine =
        run_scene(scene::parse_scene(without_indentation(), "scene.toml",
                                     {{"cells.nodes", "162"}, {"stage[4].cap", "0.1 s"}}),
                  0);
    EXPECT_LT(whole.result.work.contact_pairs, fine.result.work.contact_pairs / 2);
    EXPECT_GT(whole.result.work.contact_pairs, 0);
    // A tenth of a second after the change of mesh the cells are on their way to the same place.
    EXPECT_NEAR(whole.result.totals.contact_area_um2, fine.result.totals.contact_area_um2,
                0.2 * fine.result.totals.contact_area_um2);
}

TEST(ResumedEngine, OfOtherCellsIsRefused) {
    const scene::Scene scene = scene::parse_scene(without_indentation(), "scene.toml");
    const scene::Scene other =
        scene::parse_scene(without_indentation(), "scene.toml", {{"scene.seed", "2"}});
    const Engine first(scene, {});
    Engine second(other, {});
    EXPECT_THROW(second.resume(first.state()), Error);
}

TEST(ResumedEngine, EndsWithTheReasonOfAReaderThatFails) {
    const scene::Scene scene = scene::parse_scene(without_indentation(), "scene.toml");
    Engine engine(scene, EngineOptions{.threads = 1, .version = "", .command_line = ""});
    int n_frames = 0, n_checkpoints_after = 0;
    EngineSinks sinks;
    sinks.frame = [&](const SnapshotPtr&) -> std::optional<std::string> {
        return ++n_frames == 6 ? std::optional<std::string>("store: the disk is full")
                               : std::nullopt;
    };
    sinks.checkpoint = [&](const CheckpointData&) { n_checkpoints_after += n_frames >= 6 ? 1 : 0; };
    const RunResult result = engine.run(sinks, std::atomic<bool>{false});
    EXPECT_EQ(result.verdict, RunVerdict::sink_failed);
    EXPECT_EQ(result.message, "store: the disk is full");
    EXPECT_EQ(n_frames, 6);
    EXPECT_EQ(n_checkpoints_after, 0);  // it would count a frame that nobody has
}

}  // namespace
}  // namespace spheroscope
