// What is written on runs beside each other tells them apart, and nothing else.
#include "engine/run/changes.hpp"
#include "render/run_differences.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

namespace spheroscope::render {
namespace {

std::shared_ptr<Snapshot> last_frame_of(const std::string& resolved_scene) {
    const auto header = std::make_shared<RunHeader>();
    header->resolved_scene = resolved_scene;
    header->version = "1.0";
    const auto frame = std::make_shared<Snapshot>();
    frame->header = header;
    return frame;
}

std::vector<std::string> differences(const std::vector<SnapshotPtr>& frames) {
    return what_differs(frames);
}

const std::string k_scene = "[scene]\ntitle = \"A doublet\"\nseed = 1\n\n[cells]\nnodes = 162\n\n"
                            "[cortex.elastic]\nE = \"20 kPa\"\n\n[[stage]]\nduration = \"5 s\"\n\n"
                            "[[stage]]\nduration = \"1 s\"\n\n";

std::string with(const std::string& from, const std::string& to) {
    std::string text = k_scene;
    return text.replace(text.find(from), from.size(), to);
}

TEST(RunDifferences, AreTheSeedAndTheSettingsInTheOrderOfTheScene) {
    using Texts = std::vector<std::string>;
    const SnapshotPtr run = last_frame_of(k_scene);
    EXPECT_EQ(differences({run, last_frame_of(with("seed = 1", "seed = 2"))}),
              (Texts{"seed = 1", "seed = 2"}));
    EXPECT_EQ(differences({run, last_frame_of(with("\"1 s\"", "\"2 s\""))}),
              (Texts{"stage[1].duration = 1 s", "stage[1].duration = 2 s"}));
    EXPECT_EQ(differences({run, last_frame_of(with("seed = 1\n\n[cells]\nnodes = 162",
                                                   "seed = 2\n\n[cells]\nnodes = 642"))}),
              (Texts{"seed = 1, cells.nodes = 162", "seed = 2, cells.nodes = 642"}));
    EXPECT_EQ(differences({run, last_frame_of(with("[cortex.elastic]\nE = \"20 kPa\"\n", ""))}),
              (Texts{"[cortex.elastic]", "without [cortex.elastic]"}));
    EXPECT_EQ(differences({run, last_frame_of(with("nodes = 162\n", ""))}),
              (Texts{"cells.nodes = 162", "without cells.nodes"}));
}

TEST(RunDifferences, AreNeitherTitlesNorPicturesNorWhatIsExpected) {
    const std::vector<std::string> none(2);
    const SnapshotPtr run = last_frame_of(k_scene);
    EXPECT_EQ(differences({run, last_frame_of(k_scene)}), none);
    EXPECT_EQ(differences({run, last_frame_of(with("A doublet", "Another"))}), none);
    EXPECT_EQ(differences({run, last_frame_of(k_scene + "[[picture]]\nname = \"main\"\n")}), none);
    EXPECT_EQ(differences({run, last_frame_of(k_scene + "[expect.\"Z\"]\nmin = 1\n")}), none);
}

TEST(RunDifferences, AreChangesOnTheWayAndTheVersionWhereScenesAreTheSame) {
    const std::shared_ptr<Snapshot> changed = last_frame_of(k_scene),
                                    newer = last_frame_of(k_scene);
    changed->changes = std::make_shared<const std::vector<Change>>(std::vector<Change>{
        {3.0, "cortex.tension.gamma", {0.6}}, {4.0, "picture.given_range", {-1.0, 1.0}}});
    EXPECT_EQ(differences({last_frame_of(k_scene), changed}),
              (std::vector<std::string>{"not changed on its way",
                                        "cortex.tension.gamma = 0.6 nN/um from 3 s"}));
    const auto header = std::make_shared<RunHeader>(*newer->header);
    header->version = "1.1";
    newer->header = header;
    EXPECT_EQ(differences({last_frame_of(k_scene), newer}),
              (std::vector<std::string>{"version 1.0", "version 1.1"}));
}

}  // namespace
}  // namespace spheroscope::render
