// Two cells taken out of a run, with what everything else did to them held.
#include "engine/inspect/extract.hpp"
#include "engine/inspect/inspect_contact.hpp"
#include "tests/inspect/small_runs.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace spheroscope::inspect {
namespace {

using test::PairScene;
using test::SmallRun;

/// Three cells in a bent row, so that cell 0 is pulled aside by a third one.
SmallRun three_cells(double duration_s) {
    PairScene scene;
    scene.nodes = 42;
    scene.cells = ", [0, 15.5, 17, 9]";
    scene.stages = "[[stage]]\nkind = \"relax\"\nduration = " + std::to_string(duration_s) +
                   "\nevery = " + std::to_string(duration_s) + "\n";
    return test::run_scene_text(test::text_of(scene));
}

ExtractedPair extract(const SmallRun& run, const ContactKey& key) {
    FrameSystem whole(run.header, {}, FrameSystem::Detail::forces);
    whole.load(run.last());
    return extract_pair(whole, key, "pair.h5", 1.0);
}

Engine engine_of(const ExtractedPair& pair, bool is_held) {
    std::string text = pair.scene_toml;
    const std::string table = "[load.held]\n";
    if (!is_held) text.erase(text.find("\n" + table) + 1, table.size());
    const scene::Scene scene = scene::parse_scene(text, "pair.toml");
    GivenCells given;
    given.n_nodes = pair.header->topology->n_nodes();
    for (const float radius : pair.header->radius_um) given.radius_um.push_back(double{radius});
    for (std::size_t i = 0; i < pair.frame.x_um.size(); i += 3)
        given.x_um.emplace_back(double{pair.frame.x_um[i]}, double{pair.frame.x_um[i + 1]},
                                double{pair.frame.x_um[i + 2]});
    if (is_held) given.held = pair.load;
    return {scene, {.threads = 1, .version = {}, .command_line = {}}, given};
}

SmallRun run_pair(const ExtractedPair& pair, bool is_held) {
    Engine engine = engine_of(pair, is_held);
    return test::run_engine(engine);
}

/// The velocities of the first step that the extracted scene takes when it is run.
std::vector<Vec3> first_velocities_um_per_s(const ExtractedPair& pair) {
    Engine engine = engine_of(pair, true);
    std::atomic<bool> stop{false};
    EngineSinks sinks;
    sinks.frame = [](const SnapshotPtr&) { return std::optional<std::string>(); };
    sinks.checkpoint = [](const CheckpointData&) {};
    sinks.progress = [&](const RunProgress&) { stop = true; };
    static_cast<void>(engine.run(sinks, stop));
    EXPECT_EQ(engine.state().diagnostics.steps, 1);
    return engine.state().state.v_um_per_s;
}

double force_of(const Snapshot& frame, int a, int b) {
    for (const ContactLink& link : frame.links)
        if (link.cell_a == a && link.cell_b == b) return double{link.force_nN};
    ADD_FAILURE() << "no contact " << a << "-" << b;
    return 0.0;
}

TEST(ExtractedPair, HasTheParametersThatTheRunHadByThen) {
    PairScene text;
    text.nodes = 42;
    text.stages = "[[stage]]\nkind = \"relax\"\nduration = 0.4\nevery = 0.1\n";
    EngineOptions options{.threads = 1, .version = {}, .command_line = {}};
    options.changes = {{0.15, "contact.adhesion.omega", {0.2}},
                       {0.25, "cortex.tension.gamma", {0.7}}};
    Engine engine(scene::parse_scene(test::text_of(text), "pair"), options);
    const SmallRun run = test::run_engine(engine);
    const SmallRun pair = run_pair(extract(run, {0, 1}), true);
    EXPECT_EQ(run.frames[1]->changes, nullptr);
    ASSERT_NE(run.last()->changes, nullptr);
    EXPECT_EQ(*run.last()->changes, options.changes);
    // Each frame is looked at with what acted in it.
    FrameSystem whole(run.header, {}, FrameSystem::Detail::forces);
    for (const SnapshotPtr& frame : run.frames) {
        if (frame->links.empty()) continue;
        whole.load(frame);
        const double wanted = force_of(*frame, 0, 1);
        EXPECT_NEAR(summarize(whole, {0, 1}).centre_force_nN, wanted, 1e-3 * std::abs(wanted))
            << frame->frame;
    }
    const double wanted = force_of(*run.last(), 0, 1);
    EXPECT_NEAR(force_of(*pair.frames.front(), 0, 1), wanted, 1e-3 * std::abs(wanted));
    const std::string text_of_pair = extract(run, {0, 1}).scene_toml;
    EXPECT_TRUE(text_of_pair.starts_with("# Cells 0 and 1 of a run of")) << text_of_pair;
    const scene::Scene extracted = scene::parse_scene(text_of_pair, "extracted");
    EXPECT_DOUBLE_EQ(extracted.contact->omega_nN_per_um, 0.2);
    EXPECT_DOUBLE_EQ(extracted.cortex.tension->gamma_nN_per_um, 0.7);
}

TEST(ExtractedPair, BeginsWithTheContactForceThatTheRunHad) {
    const SmallRun run = three_cells(0.5);
    for (const ContactKey& key : {ContactKey{0, 1}, ContactKey{1, 2}}) {
        SCOPED_TRACE(key.text());
        const SmallRun pair = run_pair(extract(run, key), true);
        const double wanted = force_of(*run.last(), key.cell_a, key.cell_b);
        // Positions are stored in single precision: 1e-6 um of overlaps of 0.3 um.
        EXPECT_NEAR(force_of(*pair.frames.front(), 0, 1), wanted, 1e-4 * std::abs(wanted));
    }
}

TEST(ExtractedPair, KeepsTheForceOfACellThatIsPressedOnAndLosesItAlone) {
    PairScene scene;
    scene.nodes = 42;
    scene.extra = "[load.body_force]\nforce = [0, 0, \"10 nN\"]\nopposed = true\n";
    scene.stages = "[[stage]]\nkind = \"relax\"\nduration = 20\nevery = 20\n";
    const SmallRun run = test::run_scene_text(test::text_of(scene));
    const double wanted = force_of(*run.last(), 0, 1);
    ASSERT_NEAR(wanted, 10.0, 1.0);
    const ExtractedPair extracted = extract(run, {0, 1});
    const double held = force_of(*run_pair(extracted, true).last(), 0, 1);
    const double free = force_of(*run_pair(extracted, false).last(), 0, 1);
    EXPECT_NEAR(held, wanted, 0.05 * wanted);
    EXPECT_LT(free, 0.5 * wanted);
}

TEST(ExtractedPair, MovesAsItDidInTheRun) {
    // Held forces stand for F = Gamma v: without them the pair has other velocities.
    const SmallRun run = three_cells(0.5);
    FrameSystem whole(run.header, {}, FrameSystem::Detail::forces);
    whole.load(run.last());
    const ExtractedPair pair = extract_pair(whole, {0, 1}, "pair.h5", 1.0);
    std::vector<Vec3> v(whole.system().model().n_all_nodes(), Vec3::Zero());
    static_cast<void>(whole.system().solve_friction(whole.system().force_nN(), v, 1e-10));
    FrameSystem two(run.header, {0, 1}, FrameSystem::Detail::forces);
    two.load(run.last());
    std::vector<Vec3> force_nN(two.system().force_nN().begin(), two.system().force_nN().end());
    for (std::size_t i = 0; i < force_nN.size(); ++i) force_nN[i] += pair.load.force_nN[i];
    std::vector<Vec3> v_pair(force_nN.size(), Vec3::Zero());
    static_cast<void>(two.system().solve_friction(force_nN, v_pair, 1e-10));
    double error2 = 0.0, size2 = 0.0;
    for (std::size_t i = 0; i < v_pair.size(); ++i) {
        error2 += (v_pair[i] - v[i]).squaredNorm();
        size2 += v[i].squaredNorm();
    }
    EXPECT_LT(error2, 1e-12 * size2);
}

/// What presses on three cells, up to their last step. That one is so short that it shows the
/// velocities that forces alone give: in a longer one what stiffens cells from outside counts too.
struct Pressed {
    const char* name;
    const char* stages;
    const char* tables;
};

class PressedPair : public testing::TestWithParam<Pressed> {};

TEST_P(PressedPair, TakesTheStepThatTheRunTook) {
    PairScene text;
    text.nodes = 42;
    text.cells = ", [0, 15.5, 17, 9]";
    text.stages = GetParam().stages;
    text.extra = GetParam().tables;
    const scene::Scene scene = scene::parse_scene(test::text_of(text), "pressed.toml",
                                                  {{"method.linear_tolerance", "1e-9"}});
    Engine engine(scene, {.threads = 1, .version = {}, .command_line = {}});
    const SmallRun run = test::run_engine(engine);
    ASSERT_GT(run.n_frames(), 2);
    const SnapshotPtr& before = run.frames[run.frames.size() - 2];
    ASSERT_NEAR(run.last()->time_s - before->time_s, run.last()->diagnostics.dt_s, 1e-9)
        << "one step lies between the last two frames";
    ASSERT_LT(run.last()->diagnostics.dt_s, 3e-6);
    FrameSystem whole(run.header, {}, FrameSystem::Detail::forces);
    whole.load(before);
    const std::vector<Vec3>& v_um_per_s = engine.state().state.v_um_per_s;
    for (const ContactKey& key : {ContactKey{0, 1}, ContactKey{1, 2}}) {
        SCOPED_TRACE(key.text());
        const ExtractedPair pair = extract_pair(whole, key, "pair.h5", 1e-5);
        const std::vector<Vec3> v_pair = first_velocities_um_per_s(pair);
        double error2 = 0.0, size2 = 0.0;
        std::size_t i = 0;
        for (const int cell : {key.cell_a, key.cell_b})
            for (const Vec3& v : whole.system().model().cell_nodes(std::span(v_um_per_s), cell)) {
                error2 += (v_pair.at(i++) - v).squaredNorm();
                size2 += v.squaredNorm();
            }
        // Frames hold positions to 1e-6 um, and contacts overlap by some 0.1 um.
        EXPECT_LT(std::sqrt(error2), 1e-3 * std::sqrt(size2));
    }
}

INSTANTIATE_TEST_SUITE_P(
    By, PressedPair,
    testing::Values(
        Pressed{"nothing", "[[stage]]\nkind = \"relax\"\nduration = 0.400002\nevery = 0.4\n", ""},
        Pressed{"body_force", "[[stage]]\nkind = \"relax\"\nduration = 0.400002\nevery = 0.4\n",
                "[load.body_force]\nforce = [0, \"3 nN\", \"10 nN\"]\n"},
        Pressed{"wall",
                "[[stage]]\nkind = \"compact\"\nduration = 2\nevery = 2\n"
                "[[stage]]\nkind = \"hold\"\nduration = 4e-6\nevery = 2e-6\n",
                ""},
        Pressed{"bead",
                "[[stage]]\nkind = \"indent\"\nforce = \"30 nN\"\n"
                "direction = [0.2, -1, 0]\nduration = 0.400002\nevery = 0.4\n",
                ""}),
    [](const auto& of) { return std::string(of.param.name); });

TEST(ExtractedPair, HoldsTheWallThatPressedIt) {
    PairScene scene;
    scene.nodes = 42;
    scene.cells = ", [0, 15.5, 17, 9]";
    scene.stages = "[[stage]]\nkind = \"compact\"\nduration = 2\nevery = 2\n";
    const SmallRun run = test::run_scene_text(test::text_of(scene));
    ASSERT_GT(run.last()->diagnostics.wall_force_nN, 1.0);
    const double wanted = force_of(*run.last(), 0, 1);
    const ExtractedPair pair = extract(run, {0, 1});
    EXPECT_NEAR(force_of(*run_pair(pair, true).frames.front(), 0, 1), wanted,
                1e-4 * std::abs(wanted));
    Vec3 sum = Vec3::Zero();
    for (const Vec3& f : pair.load.force_nN) sum += f;
    EXPECT_GT(sum.norm(), 1.0) << "the wall and the third cell push the pair";
}

TEST(ExtractedPair, IsRefusedWhereThereIsNoContact) {
    const SmallRun run = three_cells(0.5);
    try {
        static_cast<void>(extract(run, {0, 2}));
        FAIL();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what())
                      .find("do not touch in frame 1\n  hint: nearest "
                            "contacts: "),
                  std::string::npos)
            << error.what();
    }
}

TEST(ExtractedPair, SceneThatAsksForHeldForcesIsRefusedWithoutThem) {
    ExtractedPair pair = extract(three_cells(0.5), {0, 1});
    pair.load.force_nN.pop_back();
    EXPECT_THROW(static_cast<void>(run_pair(pair, true)), Error);
}

}  // namespace
}  // namespace spheroscope::inspect
