// Runs whose parameters change on the way, by somebody who watches or by a list.
#include "engine/base/error.hpp"
#include "engine/run/engine.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

namespace spheroscope {
namespace {

/// Two cells of 42 nodes that spread for two seconds.
const std::string k_doublet = R"([cells]
arrangement = "pair"
nodes = 42
radius = "8 um"
gap = "0 um"
[cortex.elastic]
E = "20 kPa"
[cortex.tension]
gamma = "0.5 nN/um"
[cortex.viscosity]
eta = "1 kPa s"
[cytosol]
controller = "pid"
[medium]
eta_f = "0.05 kPa s"
[contact]
law = "traction"
[contact.adhesion]
omega = "0.4 nN/um"
[contact.friction]
normal = "0.05 kPa s/um"
tangential = "0.05 kPa s/um"
[method]
dt_max = "0.1 s"
[[stage]]
kind = "relax"
duration = "1 s"
every = "0.25 s"
[[stage]]
kind = "relax"
duration = "1 s"
every = "0.5 s"
[[picture]]
field = "sigma_nn"
)";

scene::Scene doublet() { return scene::parse_scene(k_doublet, "doublet"); }

/// Watches all it can, and makes the given changes when their times have come.
class Watcher final : public LiveControl {
  public:
    explicit Watcher(std::vector<Change> orders) : orders_(std::move(orders)) {}

    void begin(std::shared_ptr<const RunHeader> header) override { EXPECT_NE(header, nullptr); }
    void frame(SnapshotPtr frame) override {
        time_s_ = frame->time_s;
        ++n_frames;
    }
    bool go_on(const std::atomic<bool>&) override { return n_looks < stop_after; }
    std::optional<Question> take_question() override {
        if (!asks || has_asked_) return has_asked_ = false, std::nullopt;
        has_asked_ = true;
        return Question{NodeOfCell{1, 7}};
    }
    void anatomy(std::shared_ptr<const StepAnatomy> answer) override {
        answers.push_back(std::move(answer));
    }
    void refused_question(const std::string& reason) override { reasons.push_back(reason); }
    bool wants_look() override { return true; }
    void look(SnapshotPtr now) override {
        EXPECT_EQ(now->frame, -1);
        EXPECT_GT(now->time_s, 0.0);
        time_s_ = now->time_s;
        ++n_looks;
    }
    std::vector<Change> take_changes() override {
        std::vector<Change> due;
        while (!orders_.empty() && orders_.front().time_s <= time_s_) {
            due.push_back(orders_.front());
            orders_.erase(orders_.begin());
        }
        return due;
    }
    void changed(const Change& change) override { made.push_back(change); }
    void refused(const Change&, const std::string& reason) override { reasons.push_back(reason); }

    std::vector<Change> made;
    std::vector<std::string> reasons;
    int n_frames = 0, n_looks = 0, stop_after = 1 << 30;
    bool asks = false;  // before every step what it will go through
    std::vector<std::shared_ptr<const StepAnatomy>> answers;

  private:
    bool has_asked_ = false;
    std::vector<Change> orders_;
    double time_s_ = 0.0;
};

struct Ended {
    RunResult result;
    std::vector<Change> recorded;
};

Ended run(const std::vector<Change>& changes, LiveControl* live = nullptr) {
    EngineOptions options;
    options.threads = 1;
    options.changes = changes;
    Engine engine(doublet(), options);
    Ended ended;
    EngineSinks sinks;
    sinks.frame = [](const SnapshotPtr&) { return std::optional<std::string>(); };
    sinks.live = live;
    sinks.changed = [&](const Change& change) { ended.recorded.push_back(change); };
    const std::atomic<bool> stop{false};
    ended.result = engine.run(sinks, stop);
    return ended;
}

TEST(AWatchedRun, HasTheBitsOfOneThatNobodyWatches) {
    Watcher watcher({});
    const Ended watched = run({}, &watcher);
    EXPECT_GT(watcher.n_looks, 10);
    EXPECT_EQ(watcher.n_frames, watched.result.frames);
    const Ended alone = run({});
    EXPECT_EQ(watched.result.state_hash, alone.result.state_hash);
    EXPECT_EQ(watched.result.totals.power_residual, alone.result.totals.power_residual);
}

TEST(AWatchedRun, HasTheSameBitsWhenEveryStepIsTakenApartFirst) {
    Watcher watcher({});
    watcher.asks = true;
    const Ended watched = run({}, &watcher);
    EXPECT_EQ(watched.result.state_hash, run({}).result.state_hash);
    EXPECT_TRUE(watcher.reasons.empty());
    ASSERT_GT(watcher.answers.size(), 10U);
    std::size_t n_foretold = 0;
    for (std::size_t k = 0; k < watcher.answers.size(); ++k) {
        const StepAnatomy& answer = *watcher.answers[k];
        EXPECT_TRUE(answer.outcome.accepted);
        ASSERT_TRUE(answer.node.has_value());
        EXPECT_EQ(answer.node->cell, 1);
        if (k == 0) continue;
        // It begins where the step that the one before has foretold ended.
        const StepAnatomy& before = *watcher.answers[k - 1];
        n_foretold +=
            std::abs(before.time_s + before.outcome.dt_s - answer.time_s) < 1e-9 ? 1U : 0U;
    }
    // The first step of each of the two stages is made without a pause before it.
    EXPECT_GE(n_foretold + 2, watcher.answers.size() - 1);
}

TEST(AChangedRun, IsRepeatedToTheBitByItsRecord) {
    Watcher watcher({{0.1, "cortex.tension.gamma", {0.7}},
                     {0.6, "contact.adhesion.omega", {0.25}},
                     {0.6, "method.tolerance", {0.002}},
                     {0.8, "picture.given_range", {-50.0, 80.0}},
                     {1.3, "cortex.tension.gamma", {0.4}}});
    const Ended live = run({}, &watcher);
    ASSERT_EQ(live.recorded.size(), 5U);
    EXPECT_GE(live.recorded[0].time_s, 0.1);  // the time of the step that it took effect with
    const Ended replayed = run(parse_changes(changes_text(live.recorded), "record"));
    EXPECT_EQ(replayed.result.state_hash, live.result.state_hash);
    EXPECT_EQ(replayed.result.frames, live.result.frames);
    EXPECT_NE(run({}).result.state_hash, live.result.state_hash);  // they did something
}

TEST(AChangedRun, IsNotTheSameWithAChangeLeftOut) {
    std::vector<Change> changes{{0.1, "cortex.tension.gamma", {0.7}},
                                {1.3, "cortex.tension.gamma", {0.4}}};
    const std::uint64_t both = run(changes).result.state_hash;
    changes.pop_back();
    EXPECT_NE(run(changes).result.state_hash, both);
}

TEST(AChangedRun, GoesOnFromACheckpointToTheBit) {
    const std::vector<Change> changes{{0.3, "cortex.tension.gamma", {0.7}},
                                      {1.2, "contact.adhesion.omega", {0.3}}};
    EngineOptions options;
    options.threads = 1;
    options.changes = changes;
    std::optional<RunState> state;
    EngineSinks sinks;
    sinks.frame = [](const SnapshotPtr&) { return std::optional<std::string>(); };
    sinks.checkpoint = [&](const CheckpointData& data) { state = load_run_state(data); };
    Watcher watcher({});
    watcher.stop_after = 8;
    sinks.live = &watcher;
    const std::atomic<bool> stop{false};
    EXPECT_EQ(Engine(doublet(), options).run(sinks, stop).verdict, RunVerdict::stopped);
    ASSERT_TRUE(state.has_value());
    EXPECT_GT(state->state.time_s, 0.3);
    Engine resumed(doublet(), options);
    resumed.resume(*state);
    sinks.live = nullptr;
    EXPECT_EQ(resumed.run(sinks, stop).state_hash, run(changes).result.state_hash);
}

TEST(AChange, ThatTheSceneMayNotHaveIsRefusedAndTheRunGoesOn) {
    Watcher watcher(
        {{0.1, "contact.adhesion.omega", {1.5}}, {0.1, "cortex.tension.gamma", {-1.0}}});
    const Ended ended = run({}, &watcher);
    EXPECT_EQ(ended.result.verdict, RunVerdict::finished);
    ASSERT_EQ(watcher.reasons.size(), 2U);
    EXPECT_NE(watcher.reasons[0].find("above 2 gamma"), std::string::npos) << watcher.reasons[0];
    EXPECT_NE(watcher.reasons[1].find("> 0"), std::string::npos) << watcher.reasons[1];
    EXPECT_TRUE(ended.recorded.empty());
    EXPECT_EQ(ended.result.state_hash, run({}).result.state_hash);
}

std::string refusal_of(const std::string& key, const std::vector<double>& values) {
    scene::Scene scene = doublet();
    try {
        apply_change(scene, {0.0, key, values});
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

/// What reading the scene says of the value, without the place and the line that it quotes.
std::string scenes_refusal_of(const scene::Override& set) {
    std::string text = "";
    try {
        static_cast<void>(scene::parse_scene(k_doublet, "doublet", {set}));
    } catch (const Error& error) {
        text = error.what();
    }
    return text;
}

TEST(AChange, IsRefusedForTheReasonsThatScenesHave) {
    struct Case {
        const char *key, *unit;
        double value;
    };
    for (const Case& c :
         {Case{"cortex.tension.gamma", "nN/um", 0.0}, Case{"cortex.tension.gamma", "nN/um", 1e-13},
          Case{"cortex.tension.gamma", "nN/um", 1e10},
          Case{"contact.adhesion.omega", "nN/um", -0.1},
          Case{"contact.adhesion.omega", "nN/um", 1.5},
          Case{"contact.adhesion.omega", "nN/um", 1e10}, Case{"method.tolerance", "um", -1.0},
          Case{"method.tolerance", "um", 1e7}}) {
        const std::string refusal = refusal_of(c.key, {c.value});
        const std::string scenes =
            scenes_refusal_of({c.key, fmt::format("\"{} {}\"", c.value, c.unit)});
        EXPECT_NE(refusal, "") << c.key << " " << c.value;
        // "gamma must be > 0", "W = ... is above 2 gamma = ...": up to what was got and the hint
        const std::size_t wanted =
            refusal.find(": W = ") != std::string::npos ? refusal.find("W = ") : std::size_t{0};
        const std::string reason =
            refusal.substr(wanted, refusal.find_first_of(",\n", wanted) - wanted);
        EXPECT_NE(scenes.find(reason), std::string::npos) << reason << "\n" << scenes;
    }
    EXPECT_NE(refusal_of("picture.given_range", {5.0, 5.0}).find("wants [lowest, highest]"),
              std::string::npos);
    EXPECT_NE(refusal_of("picture.given_range", {0.0, 1e20}), "");
    EXPECT_NE(refusal_of("cortex.tension.gamma", {std::nan("")}), "");
    EXPECT_NE(refusal_of("method.tolerance", {0.0}).find("while this run goes on"),
              std::string::npos);
    EXPECT_EQ(refusal_of("method.tolerance", {0.01}), "");
}

TEST(AChange, OfSomethingElseIsAnErrorBeforeTheRun) {
    EXPECT_THROW(static_cast<void>(run({{0.1, "cortex.elastic.E", {5.0}}})), Error);
    EXPECT_THROW(static_cast<void>(run({{0.1, "contact.adhesion.W", {0.5}}})), Error);
}

TEST(ARecordOfChanges, GivesBackEveryBitAndRefusesAnythingElse) {
    const std::vector<Change> changes{{0.1 + 0.2, "cortex.tension.gamma", {1.0 / 3.0}},
                                      {1e-7, "method.tolerance", {6e-3}}};
    EXPECT_EQ(parse_changes(changes_text(changes), "record"), changes);
    for (const char* text : {"1 cortex.tension.gamma", "x cortex.tension.gamma 1",
                             "1 cortex.elastic.E 1", "1 cortex.tension.gamma 1 2"})
        EXPECT_THROW(static_cast<void>(parse_changes(text, "record")), Error) << text;
}

}  // namespace
}  // namespace spheroscope
