#include "engine/base/error.hpp"
#include "tests/viewer/two_cells.hpp"
#include "viewer/model/panel_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <set>
#include <tuple>

namespace spheroscope::viewer {
namespace {

scene::Picture picture(const std::string& name) {
    scene::Picture p;
    p.name = name;
    p.field = "sigma_nn";
    return p;
}

PanelModel model_of_100_frames() {
    PanelModel model({picture("main"), picture("other")});
    for (int i = 0; i < 100; ++i) model.playback.add_frame(0.1 * i);
    return model;
}

void press(PanelModel& model, Key key, bool shift = false, bool control = false) {
    const auto action = PanelModel::action_of(key, shift, control);
    ASSERT_TRUE(action.has_value());
    static_cast<void>(model.act(*action));
}

TEST(Keys, MoveThroughTheFrames) {
    PanelModel model = model_of_100_frames();
    press(model, Key::right);
    press(model, Key::right, true);
    EXPECT_EQ(model.playback.frame(), 11);
    press(model, Key::left);
    EXPECT_EQ(model.playback.frame(), 10);
    press(model, Key::left, true);
    EXPECT_EQ(model.playback.frame(), 0);
    press(model, Key::end);
    EXPECT_EQ(model.playback.frame(), 99);
    press(model, Key::home);
    EXPECT_EQ(model.playback.frame(), 0);
    press(model, Key::space);
    EXPECT_TRUE(model.playback.is_playing());
    press(model, Key::p);  // the frame to be saved stays
    EXPECT_FALSE(model.playback.is_playing());
    EXPECT_EQ(model.playback.frame(), 0);
}

TEST(Keys, NoTwoRowsHaveTheSameKey) {
    std::set<std::tuple<Key, bool, bool>> seen;
    for (const KeyRow& row : all_keys())
        EXPECT_TRUE(seen.insert({row.key, row.shift, row.control}).second) << row.keys;
    EXPECT_FALSE(PanelModel::action_of(Key::z, false, false).has_value());
}

TEST(ViewChanges, AreUndoneAndRedoneInOrder) {
    PanelModel model = model_of_100_frames();
    const ViewSettings at_first = model.view.now();
    ViewSettings from_side = at_first;
    from_side.picture.azimuth_deg = -45.0;
    model.change_view(from_side);
    model.change_view({model.presets()[1]});
    EXPECT_EQ(model.view.now().picture.name, "other");
    press(model, Key::z, false, true);
    EXPECT_EQ(model.view.now(), from_side);
    press(model, Key::z, false, true);
    EXPECT_EQ(model.view.now(), at_first);
    press(model, Key::z, false, true);  // nothing is left to undo
    press(model, Key::y, false, true);
    press(model, Key::z, true, true);
    EXPECT_EQ(model.view.now().picture.name, "other");
}

TEST(ADrag, TurnsTheViewAndIsOneStepOfUndo) {
    PanelModel model = model_of_100_frames();
    const ViewSettings before = model.view.now();
    model.begin_drag();
    EXPECT_FALSE(model.wants_draft());
    for (int k = 0; k < 60; ++k) model.drag(1.0, 0.5);
    EXPECT_TRUE(model.wants_draft());
    model.end_drag();
    EXPECT_FALSE(model.wants_draft());
    EXPECT_NEAR(model.view.now().picture.azimuth_deg, 30.0 - 180.0 / k_half_turn_px * 60.0, 1e-9);
    EXPECT_NEAR(model.view.now().picture.elevation_deg, 20.0 + 180.0 / k_half_turn_px * 30.0, 1e-9);
    model.view.undo();
    EXPECT_EQ(model.view.now(), before);
    EXPECT_FALSE(model.view.can_undo());
}

TEST(ADrag, EndsAtStraightDownAndGoesRoundSideways) {
    ViewSettings view{picture("main")};
    view = turned(view, 0.0, 1e4);
    EXPECT_EQ(view.picture.elevation_deg, 90.0);
    for (int k = 0; k < 50; ++k) view = turned(view, 100.0, 0.0);
    EXPECT_LE(std::abs(view.picture.azimuth_deg), 180.0);
}

TEST(AView, IsAnotherOneWithAnyOtherKeyOfItsPicture) {
    const ViewSettings view{picture("main")};
    const auto with = [&](const auto& change) {
        ViewSettings other = view;
        change(other.picture);
        return other;
    };
    EXPECT_EQ(view, with([](scene::Picture&) {}));
    EXPECT_NE(view, with([](scene::Picture& p) { p.name = "other"; }));
    EXPECT_NE(view, with([](scene::Picture& p) { p.fps = 12.0; }));
    EXPECT_NE(view, with([](scene::Picture& p) { p.shots = {"play to 2 s"}; }));
    EXPECT_NE(view, with([](scene::Picture& p) { p.plot = "coordination_Z"; }));
    EXPECT_NE(view, with([](scene::Picture& p) { p.stress_axes = true; }));
    EXPECT_NE(view, with([](scene::Picture& p) { p.exploded = 0.5; }));
}

TEST(TheViewAsSceneText, IsReadBackAsTheSameView) {
    const std::string scene = "[cells]\narrangement = \"single\"\nradius = \"8 um\"\n"
                              "[cortex.tension]\ngamma = \"0.5 nN/um\"\n"
                              "[medium]\neta_f = \"0.05 kPa s\"\n"
                              "[[stage]]\nkind = \"relax\"\nduration = \"1 s\"\n";
    ViewSettings view{picture("another-view_2")};
    view.picture.range = "given";
    view.picture.given_range = {-12.5, 1.0 / 3.0};
    view.picture.cutaway = true;
    view.picture.azimuth_deg = -71.3;
    view.picture.smooth = false;
    view.picture.exploded = 0.3;
    view.picture.orbit_deg = 90.0;
    view.picture.plot = "coordination_Z";
    view.picture.shots = {"play to 2 s", "freeze 3 s, orbit 360 deg"};
    const scene::Scene read = scene::parse_scene(scene + view_text(view), "test");
    ASSERT_EQ(read.pictures.size(), 1U);
    EXPECT_EQ(ViewSettings{read.pictures[0]}, view);
}

TEST(ATypedTime, GoesThereOrSaysWhatItWants) {
    PanelModel model = model_of_100_frames();
    model.go_to_typed_time("4.04 s");
    EXPECT_EQ(model.playback.frame(), 40);
    model.go_to_typed_time("later");
    EXPECT_EQ(model.playback.frame(), 40);
    EXPECT_EQ(model.message, "error: wanted a time such as 12.5 s or 2 min, got \"later\"");
}

TEST(ARedMark, GoesToItsFrameAndPicksTheContactToBlameThere) {
    PanelModel model = model_of_100_frames();
    const SeriesRow& volume_error = row_of(Series::volume_error);
    const auto before = two_cells(), there = two_cells();
    before->frame = 0;
    before->volume_um3[0] *= 1.1F;
    there->volume_um3[1] *= 1.1F;  // of frame 7
    model.go_to_blame(7, volume_error);
    model.pick_blamed(*before);  // still on show
    EXPECT_FALSE(model.selection.has_value());
    model.pick_blamed(*there);
    ASSERT_TRUE(model.selection.has_value());
    EXPECT_EQ(model.selection->cell, 1);
    EXPECT_EQ(model.selection->other_cell, 0);  // its contact
    EXPECT_NE(model.message.find("O opens it"), std::string::npos);

    model.selection.reset();
    model.go_to_blame(7, volume_error);
    model.playback.go_to(0);  // somebody went elsewhere
    model.pick_blamed(*before);
    model.playback.go_to(7);
    model.pick_blamed(*there);
    EXPECT_FALSE(model.selection.has_value());
}

TEST(Bookmarks, BringFrameAndViewBackAlsoFromTheirFile) {
    PanelModel model = model_of_100_frames();
    model.playback.go_to(42);
    model.drag(30.0, 0.0);
    const ViewSettings marked = model.view.now();
    press(model, Key::b);
    ASSERT_EQ(model.bookmarks.size(), 1U);
    const std::string path = testing::TempDir() + "marks.bookmarks.json";
    write_bookmarks(path, model.bookmarks);
    const std::vector<Bookmark> read = read_bookmarks(path);
    ASSERT_EQ(read.size(), 1U);
    model.playback.go_to(0);
    model.change_view({model.presets()[1]});
    model.open(read[0]);
    EXPECT_EQ(model.playback.frame(), 42);
    EXPECT_EQ(model.view.now(), marked);
    EXPECT_EQ(bookmarks_path("out/a/run.h5"), "out/a/run.bookmarks.json");
}

TEST(Bookmarks, OfSomebodyElseAreRefused) {
    const std::string path = testing::TempDir() + "other.json";
    std::ofstream(path) << "{\"bookmarks\": [{\"name\": 3}]}";
    EXPECT_THROW(static_cast<void>(read_bookmarks(path)), Error);
    std::ofstream(path) << "not json";
    EXPECT_THROW(static_cast<void>(read_bookmarks(path)), Error);
    EXPECT_TRUE(read_bookmarks(path + ".absent").empty());
}

TEST(OpenNode, IsThePickedOneAndIsClosedByTheSameKey) {
    PanelModel model = model_of_100_frames();
    press(model, Key::f);
    EXPECT_FALSE(model.opened);
    EXPECT_NE(model.message.find("no node is picked"), std::string::npos);
    model.selection = Pick{17, 0, 203, 42, Vec3::Zero()};
    press(model, Key::f);
    ASSERT_TRUE(model.opened);
    EXPECT_EQ(text_of(*model.opened), "node 17:203");
    press(model, Key::o);  // one thing is open at a time
    EXPECT_EQ(text_of(*model.opened), "contact 17-42");
    EXPECT_EQ(contact_of(model.opened)->text(), "17-42");
    press(model, Key::f);
    EXPECT_EQ(text_of(*model.opened), "node 17:203");
    EXPECT_FALSE(contact_of(model.opened));
    press(model, Key::f);
    EXPECT_FALSE(model.opened);
}

TEST(OpenContact, IsThePickedOneAndIsClosedByTheSameKey) {
    PanelModel model = model_of_100_frames();
    EXPECT_FALSE(model.act(Action::open_contact));
    EXPECT_FALSE(model.opened);
    EXPECT_NE(model.message.find("no contact is picked"), std::string::npos);
    model.selection = Pick{42, 0, 0, -1, Vec3::Zero()};  // a cell where it touches none
    EXPECT_FALSE(model.act(Action::open_contact));
    EXPECT_FALSE(model.opened);
    model.selection->other_cell = 17;
    EXPECT_FALSE(model.act(Action::open_contact));
    ASSERT_TRUE(model.opened);
    EXPECT_EQ(text_of(*model.opened), "contact 17-42");
    EXPECT_TRUE(model.opened_is_new);
    EXPECT_FALSE(model.act(Action::open_contact));
    EXPECT_FALSE(model.opened);
    // Its events are for whoever knows its history.
    EXPECT_EQ(model.act(Action::event_before), Action::event_before);
    EXPECT_EQ(PanelModel::action_of(Key::right, false, true), Action::event_after);
}

}  // namespace
}  // namespace spheroscope::viewer
