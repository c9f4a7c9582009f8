#include "engine/base/error.hpp"
#include "engine/inspect/contact_story.hpp"
#include "tests/inspect/small_runs.hpp"

#include <gtest/gtest.h>

namespace spheroscope::inspect {
namespace {

using test::PairScene;
using test::run_scene_text;
using test::text_of;

ContactSummary moment(int frame, bool exists, double normal_force_nN) {
    ContactSummary s;
    s.frame = frame;
    s.time_s = 0.5 * frame;
    s.exists = exists;
    s.normal_force_nN = normal_force_nN;
    return s;
}

TEST(ContactEvents, OfTwoMomentsAreThoseOfWhetherItIsThereAndOfTheSignOfItsForce) {
    const ForceOfContact none{}, pushes{true, 2.0}, pulls{true, -1.0}, idle{true, 0.0};
    EXPECT_EQ(event_between(none, pulls), EventKind::forms);
    EXPECT_EQ(event_between(pushes, none), EventKind::breaks);
    EXPECT_EQ(event_between(pulls, pushes), EventKind::sign_change);
    EXPECT_EQ(event_between(pushes, idle), EventKind::sign_change);
    EXPECT_FALSE(event_between(idle, pulls).has_value());  // it did not push before either
    EXPECT_FALSE(event_between(none, none).has_value());
    EXPECT_FALSE(event_between(pushes, pushes).has_value());
}

TEST(ContactEvents, AreFormingBreakingAndAChangeOfSign) {
    const std::vector<ContactSummary> history{
        moment(0, false, 0.0), moment(1, true, -2.0), moment(2, true, -1.0), moment(3, true, 3.0),
        moment(4, true, 2.0),  moment(5, false, 0.0), moment(6, true, -1.0)};
    const std::vector<ContactEvent> events = find_events(history);
    ASSERT_EQ(events.size(), 4U);
    EXPECT_EQ(events[0].kind, EventKind::forms);
    EXPECT_EQ(events[0].frame, 1);
    EXPECT_EQ(events[1].kind, EventKind::sign_change);
    EXPECT_EQ(events[1].frame, 3);
    EXPECT_NEAR(events[1].time_s, 1.0 + 0.25 * 0.5, 1e-12);  // a quarter of the way from -1 to 3
    EXPECT_EQ(events[2].kind, EventKind::breaks);
    EXPECT_EQ(events[2].frame, 5);
    EXPECT_EQ(events[3].kind, EventKind::forms);

    EXPECT_EQ(next_event(events, 0), &events[0]);
    EXPECT_EQ(next_event(events, 1), &events[1]);
    EXPECT_EQ(next_event(events, 6), nullptr);
    EXPECT_EQ(previous_event(events, 6), &events[2]);
    EXPECT_EQ(previous_event(events, 1), nullptr);
    EXPECT_EQ(next_event({}, 0), nullptr);
    EXPECT_EQ(previous_event({}, 0), nullptr);
}

TEST(ContactEvents, OfAContactThatIsAlwaysThereAreNone) {
    const std::vector<ContactSummary> history{moment(0, true, -1.0), moment(1, true, -0.5)};
    EXPECT_TRUE(find_events(history).empty());
}

TEST(ContactHistory, OfCellsThatArePulledApartEndsWithABreak) {
    PairScene scene;
    scene.nodes = 42;
    scene.stages = "[[stage]]\nkind = \"relax\"\nduration = 0.6\nevery = 0.1\n";
    // More than the 14 nN that adhesion can hold.
    scene.extra = "[load.body_force]\nforce = [0, 0, \"-60 nN\"]\nopposed = true\n";
    const auto run = run_scene_text(text_of(scene));
    const ContactStory story = tell_contact(run.header, run.reader(), run.n_frames(), {0, 1});
    ASSERT_EQ(story.history.size(), run.frames.size());
    EXPECT_TRUE(story.history.front().exists);
    ASSERT_FALSE(story.history.back().exists);
    ASSERT_FALSE(story.events.empty());
    EXPECT_EQ(story.events.back().kind, EventKind::breaks);
    EXPECT_TRUE(story.at(0).report.has_value());
    EXPECT_FALSE(story.at(run.n_frames() - 1).report.has_value());
    EXPECT_EQ(story.history.back().Z_a, 0);
}

TEST(ContactHistory, OfCellsThatNeverTouchIsAMistakeWithTheNearestContacts) {
    PairScene scene;
    scene.nodes = 42;
    scene.cells = ", [0, 60, 9, 9]";
    const auto run = run_scene_text(text_of(scene));
    try {
        static_cast<void>(tell_contact(run.header, run.reader(), run.n_frames(), {0, 2}));
        ADD_FAILURE() << "no error";
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(), "error: cells 0 and 2 touch in no frame of the run\n"
                                   "  hint: nearest contacts in the last frame: 0-1");
    }
}

}  // namespace
}  // namespace spheroscope::inspect
