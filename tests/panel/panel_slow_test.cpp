// The panel as a person meets it: the real program in a window on a virtual display (Xvfb), with
// keys and mouse events of the X server (xdotool). What came of them is in the document that the
// program prints at the end.
#include "render/image_diff.hpp"
#include "render/png.hpp"
#include "tests/cli/program_runner.hpp"
#include "tests/render/baseline.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <regex>
#include <set>
#include <string>
#include <vector>

namespace spheroscope {
namespace {

class PanelRun : public ProgramRunner {
  protected:
    /// A short run in out/run.h5, with a picture.
    void make_run(const std::string& keys_of_picture = "", const std::string& size = "[640, 360]") {
        write_file("scene.toml",
                   with(all_stages_scene(), "[320, 200]", size + "\n" + keys_of_picture));
        const Outcome made = call({"run", "scene.toml", "-o", "out", "--quiet", "--threads", "1"});
        ASSERT_EQ(made.code, 0) << made.err;
    }
};

/// Turns the picture by hand, with a moment to see it.
const std::string k_drag = "xdotool mousemove 300 200 mousedown 1; settle 0.2\n"
                           "xdotool mousemove 360 200; settle 0.2\n"
                           "xdotool mousemove 420 200; settle 1\n"
                           "xdotool mouseup 1; settle\n";

class Panel : public PanelRun {
  protected:
    void SetUp() override {
        for (const char* program : {"Xvfb", "xdotool"})
            if (shell(std::string("command -v ") + program).code != 0)
                GTEST_SKIP() << program << " is not installed (Debian: xvfb, xdotool)";
    }

    std::string before_program;  ///< of the environment, "NAME=value "

    /// Shows `arguments` on a display of its own; `script` has input for when the whole run has
    /// been read and its first picture is there. The log says when something is done, so that
    /// nothing depends on how fast this machine is: `until_log TEXT` waits for it. Ctrl Q at the
    /// end closes the panel.
    Outcome
    show(const std::string& arguments, const std::string& script,
         const std::string& server_options = "",
         const std::string& ready = "until_log 'was read after'; until_log 'first picture'\n") {
        return shell("rm -f display; Xvfb -displayfd 3 -screen 0 1760x1060x24 -nolisten tcp " +
                     server_options +
                     " 3>display 2>server.log & server=$!\n"
                     "for i in $(seq 200); do [ -s display ] && break; sleep 0.05; done\n"
                     "export DISPLAY=:$(cat display)\n" +
                     before_program + "\"$PROGRAM\" view " + arguments +
                     " --json >report.json 2>log & panel=$!\n"
                     "until_log() { for i in $(seq 600); do grep -q \"$1\" log && break; "
                     "kill -0 $panel 2>/dev/null || break; sleep 0.05; done; }\n"
                     // a moment for the panel to draw what it was told
                     "settle() { sleep ${1:-0.6}; }\n"
                     "xdotool mousemove 300 950\n" +
                     ready + script +
                     "\nwait $panel; code=$?; cat report.json; cat log >&2; kill $server; "
                     "wait $server 2>/dev/null; exit $code");
    }

    /// The same for a scene that is simulated meanwhile, from a pause before its first step.
    Outcome show_live(const std::string& script) {
        write_file("scene.toml", with(all_stages_scene(), "[320, 200]", "[640, 360]"));
        return show("scene.toml -o out --threads 1 --paused", script, "",
                    "until_log 'engine waits'; settle\n");
    }
};

TEST_F(Panel, KeysMoveThroughTheFrames) {
    make_run();
    const Outcome outcome = show("out/run.h5", "xdotool key Right Right Right Left; settle\n"
                                               "xdotool key shift+Right; settle\n"
                                               "xdotool key ctrl+q");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const nlohmann::json report = json_of(outcome);
    EXPECT_EQ(report["frame"], 12);
    EXPECT_GT(report["frames"], 12);
}

TEST_F(Panel, ADragTurnsTheViewAndUndoTurnsItBack) {
    make_run();
    const Outcome turned = show("out/run.h5", k_drag + "xdotool key ctrl+q");
    ASSERT_EQ(turned.code, 0) << turned.err;
    EXPECT_EQ(json_of(turned)["view"].get<std::string>().find("azimuth = \"30 deg\""),
              std::string::npos);
    EXPECT_GT(json_of(turned)["draft_s"], 0.0);  // it was drawn while it was turned
    EXPECT_GT(json_of(turned)["dragged_pictures"], 0);
    EXPECT_GT(json_of(turned)["dragged_s"], 0.0);
    const Outcome back = show("out/run.h5", k_drag + "xdotool key ctrl+z; settle\n"
                                                     "xdotool key ctrl+q");
    EXPECT_NE(json_of(back)["view"].get<std::string>().find("azimuth = \"30 deg\""),
              std::string::npos);
}

TEST_F(Panel, ANumberThatAPictureCannotHaveIsRefusedAndChangesNothing) {
    make_run();
    // a key is held until a frame of the panel has seen it
    const auto type = [](const std::string& number) {
        return "settle 0.3; xdotool key --delay 500 ctrl+a; xdotool type -- " + number +
               "; settle 0.3; xdotool key --delay 500 Return; settle 0.3\n";
    };
    // the fields of panel 'View': angles, and the slider by which cells are pulled apart
    const std::string azimuth = "xdotool mousemove 1385 227 click 1; ";
    const std::string elevation = "xdotool mousemove 1460 227 click 1; ";
    const std::string apart = "xdotool mousemove 1423 199 keydown ctrl click 1 keyup ctrl; ";
    const Outcome refused = show("out/run.h5", azimuth + type("-7.125e1") + elevation +
                                                   type("120") + "xdotool key ctrl+q");
    ASSERT_EQ(refused.code, 0) << refused.err;
    const std::string view = json_of(refused)["view"];
    EXPECT_NE(view.find("azimuth = \"-71.25 deg\""), std::string::npos) << view;
    EXPECT_NE(view.find("elevation = \"20 deg\""), std::string::npos) << view;
    EXPECT_EQ(json_of(refused)["message"], "picture.elevation must be -90 ... 90 deg, got 120 deg");
    const Outcome pulled =
        show("out/run.h5", apart + type("2.5") + apart + type("-1") + "xdotool key ctrl+q");
    ASSERT_EQ(pulled.code, 0) << pulled.err;
    EXPECT_NE(json_of(pulled)["view"].get<std::string>().find("exploded = 2.5\n"),
              std::string::npos)
        << json_of(pulled)["view"];
    EXPECT_EQ(json_of(pulled)["message"], "picture.exploded must be >= 0, got -1");
}

TEST_F(Panel, AClickPicksAndTheTableCanBeCopied) {
    make_run();
    // the middle of the picture of 640 x 360, left of its keys, inside the panel's margins
    const Outcome outcome = show("out/run.h5", "xdotool key End; settle 1\n"
                                               "xdotool mousemove 240 205 click 1\n"
                                               "until_log picked\n"
                                               "xdotool key ctrl+t\n"
                                               "xdotool key ctrl+q");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const nlohmann::json report = json_of(outcome);
    ASSERT_TRUE(report["selection"].is_object());
    const std::string copied = report["copied"];
    EXPECT_NE(copied.find("of,quantity,value,unit"), std::string::npos);
    EXPECT_NE(copied.find("cell " + std::to_string(report["selection"]["cell"].get<int>())),
              std::string::npos);
}

TEST_F(Panel, OpensAContactAsInspectDrawsItAndGoesToItsEvents) {
    make_run("cutaway = true");  // faces that cells have turned to each other are seen
    const Outcome outcome = show("out/run.h5", "xdotool key End; settle 1\n"
                                               "for x in $(seq 130 10 350); do\n"
                                               "xdotool mousemove $x 205 click 1; settle 0.3\n"
                                               "grep -q 'contact with' log && break; done\n"
                                               "xdotool key o p\n"
                                               "until_log 'written to'\n"
                                               "xdotool key ctrl+Left; settle\n"
                                               "xdotool key ctrl+q");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const nlohmann::json report = json_of(outcome);
    ASSERT_TRUE(report["contact"].is_string()) << "the click met no contact";
    const std::string contact = report["contact"];
    ASSERT_EQ(report["files"].size(), 1U);
    const render::PngFile saved = render::read_png(path(report["files"][0].get<std::string>()));
    const Outcome drawn =
        call({"inspect", "out/run.h5", "--contact", contact, "-o", "sheet.png", "--quiet"});
    ASSERT_EQ(drawn.code, 0) << drawn.err;
    EXPECT_TRUE(saved.image == render::read_png(path("sheet.png")).image);
    EXPECT_NE(saved.texts.at("Command").find("--contact " + contact), std::string::npos);
    // The last of its events is where inspect says.
    const Outcome events =
        call({"inspect", "out/run.h5", "--contact", contact, "--events", "--json"});
    ASSERT_EQ(events.code, 0) << events.err;
    const nlohmann::json rows = json_of(events)["events"];
    ASSERT_FALSE(rows.empty());
    int last_event = -1;
    for (const nlohmann::json& row : rows)
        if (row["frame"] < report["frames"].get<int>() - 1) last_event = row["frame"];
    EXPECT_EQ(report["frame"], last_event);
}

TEST_F(Panel, OpensTheForcesOnANodeAsInspectDrawsThem) {
    make_run();
    const Outcome outcome = show("out/run.h5", "xdotool key End; settle 1\n"
                                               "xdotool mousemove 240 205 click 1\n"
                                               "until_log picked\n"
                                               "xdotool key f p\n"
                                               "until_log 'written to'\n"
                                               "xdotool key ctrl+q");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const nlohmann::json report = json_of(outcome);
    ASSERT_TRUE(report["node"].is_string());
    const std::string node = report["node"];
    EXPECT_EQ(node, std::to_string(report["selection"]["cell"].get<int>()) + ":" +
                        std::to_string(report["selection"]["node"].get<int>()));
    ASSERT_EQ(report["files"].size(), 1U);
    const render::PngFile saved = render::read_png(path(report["files"][0].get<std::string>()));
    const Outcome drawn =
        call({"inspect", "out/run.h5", "--node", node, "-o", "node.png", "--quiet"});
    ASSERT_EQ(drawn.code, 0) << drawn.err;
    EXPECT_TRUE(saved.image == render::read_png(path("node.png")).image);
    EXPECT_NE(saved.texts.at("Command").find("--node " + node), std::string::npos);
}

TEST_F(Panel, LooksAsItsBaseline) {
    make_run("range = \"frame\"\nnetwork = true", "[1000, 640]");
    const Outcome outcome = show("out/run.h5", "xdotool key End; settle 1\n"
                                               "xdotool key shift+p; until_log 'written to'\n"
                                               "mv out/panel.png out/last.png\n"
                                               "xdotool key Left; settle 1\n"
                                               "xdotool key shift+p; settle 1\n"
                                               "xdotool key ctrl+q");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    // The run is computed anew, so that bits may differ where libraries choose other instructions.
    const render::Drawn last{render::read_png(path("out/last.png")).image, ""};
    render::expect_as_baseline("panel", last);
    // The frame before has another time, other numbers and its cursors elsewhere: that is seen.
    const render::Image before = render::read_png(path("out/panel.png")).image;
    const render::Image baseline = render::read_png(render::baseline_path("panel")).image;
    EXPECT_FALSE(
        render::broken_bounds(render::compare_images(baseline, before, render::k_threshold),
                              render::k_other_machine)
            .empty());
}

TEST_F(Panel, ShowsThePixelsThatTheMovieHas) {
    make_run();
    ASSERT_EQ(call({"movie", "out/run.h5", "--quiet"}).code, 0);
    const Outcome outcome = show("out/run.h5", k_drag + "xdotool key ctrl+z End p\n"
                                                        "until_log 'written to'\n"
                                                        "xdotool key ctrl+q");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const nlohmann::json report = json_of(outcome);
    EXPECT_GT(report["draft_s"], 0.0);  // drafts before it leave no trace
    ASSERT_EQ(report["files"].size(), 1U);
    const int last = report["frame"];
    char name[32];
    std::snprintf(name, sizeof name, "%06d.png", last);
    const render::PngFile saved = render::read_png(path(report["files"][0].get<std::string>()));
    const render::PngFile drawn = render::read_png(path("out/frames/main") / name);
    EXPECT_TRUE(saved.image == drawn.image);
    EXPECT_EQ(saved.texts.at("Fingerprint"), drawn.texts.at("Fingerprint"));
}

TEST_F(Panel, IsNeitherEmptyNorOfOneColour) {
    make_run();
    const Outcome outcome = show("out/run.h5", "xdotool key End; settle 1\n"
                                               "xdotool key shift+p\n"
                                               "until_log 'written to'\n"
                                               "xdotool key ctrl+q");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const render::Image panel = render::read_png(path("out/panel.png")).image;
    ASSERT_GT(panel.width, 1000);
    std::set<int> colours;
    const auto count_in = [&](int x0, int y0, int x1, int y1) {
        colours.clear();
        for (int y = y0; y < y1; ++y)
            for (int x = x0; x < x1; ++x) {
                const render::Rgb c = panel.at(x, y);
                colours.insert((c.r << 16) | (c.g << 8) | c.b);
            }
        return colours.size();
    };
    EXPECT_GT(count_in(20, 20, 660, 380), 100U);                             // the picture
    EXPECT_GT(count_in(panel.width - 360, 20, panel.width - 10, 300), 20U);  // the controls
    EXPECT_GT(count_in(20, panel.height - 150, panel.width - 20, panel.height - 10), 20U);  // plots
}

TEST_F(Panel, SurvivesAWindowOfNothing) {
    make_run();
    const Outcome outcome = show("out/run.h5", "id=$(xdotool search --name spheroscope | head -1)\n"
                                               "xdotool windowsize $id 1 1; settle\n"
                                               "xdotool windowsize $id 300 200; settle\n"
                                               "xdotool windowsize $id 1720 1010; settle\n"
                                               "xdotool key Right; settle\n"
                                               "xdotool key ctrl+q");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(json_of(outcome)["frame"], 1);
}

TEST_F(Panel, APauseOfTheEngineIsOneAndEachStepIsSingle) {
    // To the first stage with mechanics, two steps, and a moment in which nothing may happen.
    const Outcome outcome = show_live("xdotool key n; until_log 'stage 1, compact, begins'\n"
                                      "until_log 'paused at'; settle\n"
                                      "xdotool key period; settle; xdotool key period; settle 1\n"
                                      "xdotool key Left; settle\n"
                                      "xdotool key ctrl+q");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    std::vector<int> steps;
    const std::regex line("paused at t = [^ ]* s, step ([0-9]+)");
    for (std::sregex_iterator it(outcome.err.begin(), outcome.err.end(), line), end; it != end;
         ++it)
        steps.push_back(std::stoi((*it)[1]));
    ASSERT_EQ(steps.size(), 3U) << outcome.err;
    EXPECT_EQ(steps[1], steps[0] + 1);
    EXPECT_EQ(steps[2], steps[0] + 2);
    EXPECT_EQ(json_of(outcome)["run"]["work"]["steps"], steps[2]);
    EXPECT_EQ(json_of(outcome)["run"]["outcome"], "stopped");
    // What was stopped goes on without a display.
    EXPECT_EQ(call({"run", "scene.toml", "-o", "out", "--resume", "--quiet"}).code, 0);
}

TEST_F(Panel, TakesTheNextStepApartWithoutMakingIt) {
    const Outcome outcome = show_live("xdotool key i; until_log 'seeding moves beads'\n"
                                      "xdotool key n; until_log 'stage 1, compact, begins'\n"
                                      "until_log 'paused at'; settle\n"
                                      "xdotool key i; until_log 'took the step'; settle\n"
                                      "xdotool key period; settle 1\n"
                                      "xdotool key ctrl+q");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    std::smatch paused, taken;
    ASSERT_TRUE(std::regex_search(outcome.err, paused,
                                  std::regex("paused at t = ([^ ]*) s, step ([0-9]+)")));
    ASSERT_TRUE(std::regex_search(
        outcome.err, taken, std::regex("took the step at t = ([^ ]*) s apart, ([0-9]+) phases")));
    EXPECT_EQ(taken[1], paused[1]) << outcome.err;
    EXPECT_GE(std::stoi(taken[2]), 2);  // forces, and a solve
    EXPECT_EQ(json_of(outcome)["run"]["work"]["steps"], std::stoi(paused[2]) + 1);
}

TEST_F(Panel, WhatIsChangedInALiveRunIsRepeatedToTheBitWithoutADisplay) {
    const Outcome outcome =
        show_live("xdotool key n; until_log 'stage 1, compact, begins'; settle\n"
                  // the first slider of the panel of the engine, right of its middle
                  "xdotool mousemove 1500 108 click 1; settle\n"
                  "xdotool key space; until_log 'the run is over: '\n"
                  "xdotool key ctrl+q");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const nlohmann::json report = json_of(outcome);
    const std::string changes = report["changes"];
    EXPECT_NE(changes.find("cortex.tension.gamma"), std::string::npos) << changes;
    const Outcome again = call({"run", "out/run.h5", "-o", "again", "--json", "--quiet"});
    EXPECT_EQ(again.code, 0) << again.err;
    EXPECT_EQ(json_of(again)["state_hash"], report["run"]["state_hash"]);
    EXPECT_EQ(json_of(again)["frames"], report["run"]["frames"]);
    const Outcome without = call({"run", "scene.toml", "-o", "w", "--json", "--quiet"});
    EXPECT_NE(json_of(without)["state_hash"], report["run"]["state_hash"]);
}

TEST_F(Panel, WithoutPicturesALiveRunStillSaysWhatItHasComeTo) {
    before_program = "LD_PRELOAD=libGL.so.1 ";  // an OpenGL that is not the pictures' own
    const Outcome outcome = show_live("");
    EXPECT_EQ(outcome.code, 5) << outcome.err;
    EXPECT_NE(outcome.err.find("no pictures can be drawn"), std::string::npos) << outcome.err;
    EXPECT_EQ(json_of(outcome)["run"]["outcome"], "stopped") << outcome.out;
}

TEST_F(PanelRun, WithoutADisplaySaysWhatToDoInstead) {
    make_run();
    const Outcome outcome = shell("unset DISPLAY WAYLAND_DISPLAY; \"$PROGRAM\" view out/run.h5");
    EXPECT_EQ(outcome.code, 5);
    EXPECT_NE(outcome.err.find("needs a display"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("`movie`"), std::string::npos) << outcome.err;
}

TEST_F(Panel, OnAServerWithoutOpenGlSaysSo) {
    make_run();
    const Outcome outcome = show("out/run.h5", "", "-extension GLX");
    EXPECT_EQ(outcome.code, 5) << outcome.err;
    EXPECT_NE(outcome.err.find("OpenGL"), std::string::npos) << outcome.err;
}

TEST_F(Panel, RefusesWhatIsNoRun) {
    write_file("no.h5", "not a run");
    const Outcome outcome = show("no.h5", "");
    EXPECT_EQ(outcome.code, 2) << outcome.err;
}

}  // namespace
}  // namespace spheroscope
