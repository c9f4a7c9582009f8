// Frames of a file as the panel gets them: what is wrong with one takes nothing from the others.
#include "tests/inspect/small_runs.hpp"
#include "tests/store/run_samples.hpp"
#include "viewer/stored_frames.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace spheroscope::viewer {
namespace {

const inspect::ContactKey k_contact{0, 1};

template <class Condition> bool comes_true(const Condition& condition) {
    for (int k = 0; k < 5000 && !condition(); ++k)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return condition();
}

class StoredFramesTest : public testing::Test {
  protected:
    /// Two cells in five frames; `change` may spoil any of them.
    template <class Change> std::string write(const Change& change) {
        const test::SmallRun run = test::run_scene_text(test::text_of(
            {.stages = "[[stage]]\nkind = \"relax\"\nduration = 0.4\nevery = 0.1\n"}));
        const std::string path = folder_ / "run.h5";
        RunFileWriter writer =
            RunFileWriter::create(path, *run.header, RunFileWriter::Existing::refuse);
        n_frames = run.n_frames();
        for (const SnapshotPtr& frame : run.frames) {
            Snapshot written = *frame;
            change(written);
            writer.write(written);
        }
        return path;
    }
    int n_frames = 0;

  private:
    samples::Folder folder_;
};

/// Of a stage that the scene does not have: it can be read, but not be computed with.
void make_contact_fail(Snapshot& frame) { frame.stage = 9; }
/// A contact with a cell that is not there.
void make_unreadable(Snapshot& frame) { frame.links = {{0, 7, 1.0F, 1.0F}}; }

TEST_F(StoredFramesTest, AContactThatFailsInTheLastFrameLeavesFramesAndOtherContactsAlone) {
    const std::string path = write([](Snapshot& frame) {
        if (frame.frame == 4) make_contact_fail(frame);
    });
    ASSERT_EQ(n_frames, 5);
    StoredFrames frames(path, [] {});
    frames.watch_contact(k_contact);
    ASSERT_TRUE(comes_true([&] { return !frames.contact_failure().empty(); }));
    EXPECT_NE(frames.contact_failure().find("before frame 4"), std::string::npos)
        << frames.contact_failure();
    EXPECT_EQ(frames.failure(), "");
    EXPECT_TRUE(comes_true([&] { return frames.contact_history()->size() == 4U; }));
    frames.begin_survey();
    EXPECT_TRUE(comes_true([&] { return frames.n_surveyed() == n_frames; }));
    EXPECT_TRUE(comes_true([&] { return frames.frame(4) != nullptr; }));
    frames.watch_contact({});
    EXPECT_EQ(frames.contact_failure(), "");
    EXPECT_EQ(frames.contact_history(), nullptr);
    frames.watch_contact(k_contact);
    EXPECT_TRUE(comes_true([&] { return frames.contact_history()->size() == 4U; }));
}

TEST_F(StoredFramesTest, AFrameThatCannotBeReadIsMissedWhereItIsAskedForAndNowhereElse) {
    const std::string path = write([](Snapshot& frame) {
        if (frame.frame == 2) make_unreadable(frame);
    });
    StoredFrames frames(path, [] {});
    frames.begin_survey();
    EXPECT_TRUE(comes_true([&] { return frames.n_surveyed() == n_frames; }));
    EXPECT_EQ(frames.survey().n_unreadable(), 1);
    EXPECT_EQ(frames.survey().summaries().size(), static_cast<std::size_t>(n_frames - 1));
    for (const int number : {0, 1, 3, 4}) {
        EXPECT_TRUE(comes_true([&] { return frames.frame(number) != nullptr; })) << number;
        EXPECT_EQ(frames.failure(), "") << number;
    }
    EXPECT_EQ(frames.frame(2), nullptr);
    EXPECT_NE(frames.failure().find("contact between cells 0 and 7"), std::string::npos)
        << frames.failure();
    frames.watch_contact(k_contact);
    ASSERT_TRUE(comes_true([&] { return !frames.contact_failure().empty(); }));
    EXPECT_TRUE(comes_true([&] { return frames.contact_history()->size() == 2U; }));
}

TEST_F(StoredFramesTest, TheScaleDoesNotSeeFramesThatCannotBeRead) {
    const std::string whole = write([](Snapshot&) {});
    StoredFrames frames(whole, [] {});
    frames.begin_survey();
    ASSERT_TRUE(comes_true([&] { return frames.n_surveyed() == n_frames; }));
    SnapshotPtr last;
    ASSERT_TRUE(comes_true([&] { return (last = frames.frame(n_frames - 1)) != nullptr; }));
    RunSurvey survey(*last->header);
    for (int k = 0; k < n_frames - 1; ++k) survey.add_unreadable(last->time_s);
    survey.add(*last);
    const render::View view = survey.view_of(*last, {}, n_frames);
    EXPECT_DOUBLE_EQ(view.fit_radius_um.value(), render::shown_extent_um(*last, {}));
}

}  // namespace
}  // namespace spheroscope::viewer
