// What the panel knows of a running engine, without one.
#include "tests/viewer/two_cells.hpp"
#include "viewer/model/kept_looks.hpp"
#include "viewer/model/live_channel.hpp"
#include "viewer/model/panel_model.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace spheroscope::viewer {
namespace {

std::shared_ptr<Snapshot> state(double time_s, std::vector<ContactLink> links, int stage = 0) {
    auto snapshot = two_cells();
    snapshot->frame = -1;
    snapshot->time_s = time_s;
    snapshot->links = std::move(links);
    snapshot->stage = stage;
    return snapshot;
}

const std::vector<ContactLink> k_one{{0, 1, 2.0F, 10.0F}};
const std::vector<ContactLink> k_two{{0, 1, -2.0F, 10.0F}, {1, 4, 1.0F, 3.0F}};

std::string event(const std::vector<ContactLink>& before, const std::vector<ContactLink>& now,
                  const Watched& watched = {}) {
    return event_between(*state(1.0, before), *state(2.0, now), watched).value_or("");
}

TEST(Events, AreContactsThatFormBreakOrChangeSign) {
    EXPECT_EQ(event(k_one, k_one), "");
    EXPECT_EQ(event(k_one, k_two), "t = 2 s: contact 0-1 begins to pull, and 1 more");
    EXPECT_EQ(event(k_two, k_one), "t = 2 s: contact 0-1 begins to push, and 1 more");
    EXPECT_EQ(event({}, k_one), "t = 2 s: contact 0-1 forms");
    EXPECT_EQ(event(k_one, {}), "t = 2 s: contact 0-1 breaks");
    // no force is no pushing, as in the history of a contact
    EXPECT_EQ(event(k_one, {{0, 1, 0.0F, 10.0F}}), "t = 2 s: contact 0-1 begins to pull");
    EXPECT_EQ(event({{0, 1, -1.0F, 10.0F}}, {{0, 1, 0.0F, 10.0F}}), "");
}

TEST(Events, OfOtherContactsThanTheWatchedOnesAreNone) {
    EXPECT_EQ(event(k_one, k_two, {4, -1}), "t = 2 s: contact 1-4 forms");
    EXPECT_EQ(event(k_one, k_two, {1, 4}), "t = 2 s: contact 1-4 forms");
    EXPECT_EQ(event(k_one, k_two, {0, 4}), "");
    EXPECT_EQ(event(k_one, k_two, {7, -1}), "");
}

TEST(Events, AreBeginsOfStagesAndNothingWhileBeadsArePacked) {
    EXPECT_EQ(event_between(*state(1.0, k_one, 0), *state(2.0, k_one, 1), {}).value(),
              "t = 2 s: stage 1, relax, begins");
    const auto before = state(0.0, k_one), now = state(0.0, k_two);
    before->stage_name = now->stage_name = "anneal";
    EXPECT_FALSE(event_between(*before, *now, {}).has_value());
}

TEST(RunningUntilAnEvent, PausesTheEngineThereAndSaysWhy) {
    LiveChannel channel([] {});
    channel.run_until_event({});
    for (int k = 0; k < 5; ++k) {
        EXPECT_TRUE(channel.wants_look()) << "each step is looked at";
        channel.look(state(0.1 * k, k_one));
        EXPECT_FALSE(channel.is_paused());
    }
    channel.look(state(0.5, k_two));
    EXPECT_TRUE(channel.is_paused());
    EXPECT_EQ(channel.take_messages(),
              std::vector<std::string>{"t = 0.5 s: contact 0-1 begins to pull, and 1 more"});
    EXPECT_TRUE(channel.take_messages().empty());
    channel.play();
    channel.look(state(0.6, k_one));
    EXPECT_FALSE(channel.is_paused()) << "one event was asked for";
}

TEST(ARefusal, IsNotLostWhenAnEventFollowsBeforeAnybodyLooks) {
    LiveChannel channel([] {});
    channel.run_until_event({});
    channel.look(state(0.1, k_one));
    channel.refused({0.0, "cortex.tension.gamma", {-1.0}}, "gamma must be > 0");
    channel.look(state(0.2, k_two));
    const std::vector<std::string> messages = channel.take_messages();
    ASSERT_EQ(messages.size(), 2U);
    EXPECT_EQ(messages[0], "gamma must be > 0");
    EXPECT_NE(messages[1].find("begins to pull"), std::string::npos);
}

TEST(Orders, OfTheSameKeyReplaceEachOtherUntilTheyAreTaken) {
    LiveChannel channel([] {});
    channel.order({0.0, "cortex.tension.gamma", {0.6}});
    channel.order({0.0, "method.tolerance", {0.01}});
    channel.order({0.0, "cortex.tension.gamma", {0.7}});
    const std::vector<Change> taken = channel.take_changes();
    ASSERT_EQ(taken.size(), 2U);
    EXPECT_EQ(taken[1], (Change{0.0, "cortex.tension.gamma", {0.7}}));
    EXPECT_TRUE(channel.take_changes().empty());
}

TEST(KeptStates, GoFromTheNewestBackAndStayWithinTheirMemory) {
    const std::size_t bytes = 4 * bytes_of(*state(0.0, k_one));
    KeptLooks looks(bytes - 1);
    EXPECT_EQ(looks.back(0), nullptr);
    for (int k = 0; k < 10; ++k) looks.add(state(k, k_one));
    EXPECT_EQ(looks.size(), 3);
    EXPECT_EQ(looks.back(0)->time_s, 9.0);
    EXPECT_EQ(looks.back(2)->time_s, 7.0);
    EXPECT_EQ(looks.back(3), nullptr);
}

PanelModel live_model() {
    PanelModel model({scene::Picture{}});
    model.live.emplace();
    model.follow_engine();
    for (int k = 0; k < 10; ++k) model.playback.add_frame(1.0 * k);
    model.live->n_looks = 4;
    model.live->oldest_look_s = 7.5;
    return model;
}

void act(PanelModel& model, Action action) { static_cast<void>(model.act(action)); }

TEST(StepsBack, GoThroughKeptStatesAndThenToTheFrameBeforeThem) {
    PanelModel model = live_model();
    EXPECT_EQ(model.playback.frame(), 9);
    for (int back = 1; back <= 3; ++back) {
        act(model, Action::back);
        EXPECT_TRUE(model.shows_engine());
        EXPECT_EQ(model.live->looks_back, back);
    }
    act(model, Action::forward);
    EXPECT_EQ(model.live->looks_back, 2);
    act(model, Action::back);
    act(model, Action::back);
    EXPECT_FALSE(model.shows_engine());
    EXPECT_EQ(model.playback.frame(), 7);
    act(model, Action::back);
    EXPECT_EQ(model.playback.frame(), 6);
    model.playback.add_frame(10.0);
    EXPECT_EQ(model.playback.frame(), 6) << "a frame that was chosen stays";
    act(model, Action::last);
    EXPECT_TRUE(model.shows_engine());
    EXPECT_EQ(model.live->looks_back, 0);
    model.playback.add_frame(11.0);
    EXPECT_EQ(model.playback.frame(), 11);
}

TEST(Pace, IsModelTimeOverWallTimeWithoutPauses) {
    Pace pace;
    EXPECT_TRUE(std::isnan(pace.recent()));
    for (int k = 0; k <= 100; ++k) pace.see(0.3 * k, 100.0 + 0.1 * k);
    EXPECT_NEAR(pace.recent(), 3.0, 1e-9);
    pace.interrupt();
    for (int k = 0; k <= 100; ++k) pace.see(30.0 + 0.1 * k, 1000.0 + 0.1 * k);
    EXPECT_NEAR(pace.recent(), 1.0, 1e-9);
    EXPECT_NEAR(pace.overall(), 2.0, 1e-9);
}

}  // namespace
}  // namespace spheroscope::viewer
