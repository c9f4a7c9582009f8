#include "engine/base/error.hpp"
#include "render/movie.hpp"
#include "render/provenance.hpp"
#include "render/verify.hpp"
#include "tests/render/drifting_pair.hpp"
#include "tests/render/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <string>

namespace spheroscope::render {
namespace {

class Verify : public testing::Test {
  protected:
    Verify() {
        settings_.picture = synthetic::make_picture("mean_stress");
        settings_.picture.size_px = {320, 180};
        settings_.picture.plot = "sigma_h_core";
        settings_.picture.fps = 10.0;
        settings_.picture.shots = {"play to 0.5 s", "cutaway on", "freeze 0.1 s, orbit 33.3 deg"};
        settings_.frames_folder = folder_.path() / "frames";
        settings_.movie_path = folder_.path() / "a.mp4";
        settings_.drawn_by = "test";
    }
    [[nodiscard]] PngFile picture(int i) const {
        return read_png(settings_.frames_folder / ("00000" + std::to_string(i) + ".png"));
    }
    static Verification verify(const PngFile& file, FrameSource& run) {
        FrameSource* const runs[]{&run};
        return verify_picture(file, runs, "test");
    }
    static std::string refusal(const PngFile& file, FrameSource& run) {
        try {
            static_cast<void>(verify(file, run));
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::usage);
            return error.what();
        }
        return "";
    }
    TemporaryFolder folder_;
    MovieSettings settings_;
    DriftingPair run_{4};
};

TEST_F(Verify, DrawsEveryPictureOfAMovieAgainToTheBit) {
    ASSERT_EQ(make_movie(run_, settings_).n_frames, 4);
    for (int i = 0; i < 4; ++i) {
        const Verification result = verify(picture(i), run_);
        EXPECT_TRUE(result.is_same_machine);
        EXPECT_TRUE(result.reasons.empty()) << i << ": " << result.reasons.front();
        EXPECT_EQ(result.frame, std::min(i, 2));
    }
}

TEST_F(Verify, SeesOnePixelThatWasChangedAndAnotherStress) {
    make_movie(run_, settings_);
    PngFile file = picture(3);
    file.image.set(5, 5, {0, 0, 1});
    EXPECT_FALSE(verify(file, run_).reasons.empty());
    file.texts[k_drawn_with_key] = "another machine";
    EXPECT_TRUE(verify(file, run_).reasons.empty()) << "one pixel is within the tolerance there";
    DriftingPair opposite(4, -0.01F);
    EXPECT_FALSE(verify(file, opposite).reasons.empty());
}

TEST_F(Verify, OfTwoRunsWantsBoth) {
    DriftingPair other(4, 0.05F, 1.0);
    make_comparison(run_, other, settings_);
    const PngFile file = picture(1);
    ASSERT_EQ(n_shown(file.texts), 2);
    FrameSource* const runs[]{&run_, &other};
    EXPECT_TRUE(verify_picture(file, runs, "test").reasons.empty());
    FrameSource* const same_twice[]{&run_, &run_};
    EXPECT_FALSE(verify_picture(file, same_twice, "test").reasons.empty());
}

TEST_F(Verify, DrawsSeveralFramesOfOneRunAgain) {
    scene::Picture plain = settings_.picture;
    plain.plot.clear();
    const Survey survey = survey_frames(run_, plain);
    FrameSource* const runs[]{&run_, &run_, &run_};
    MoviePainter painter(runs, std::vector<Survey>(3, survey), plain, "test");
    std::vector<MoviePainter::Shown> shown(3);
    for (int k = 0; k < 3; ++k) shown[static_cast<std::size_t>(k)].frame = k + 1;
    shown[1].view.heading = "b  relaxation";
    painter.set_caption({"A line that is so long that it has no room in a row", "Made by: test"});
    PngFile file{painter.paint(shown), painter.texts(shown)};
    file.texts[k_drawn_with_key] = painter.drawn_with();
    ASSERT_EQ(n_shown(file.texts), 3);
    EXPECT_TRUE(verify_picture(file, runs, "test").reasons.empty());
    file.texts[std::string(MoviePainter::k_beside) + MoviePainter::k_beside + "Frame"] = "1";
    EXPECT_FALSE(verify_picture(file, runs, "test").reasons.empty()) << "the third one counts";
    file.texts[std::string(MoviePainter::k_beside) + MoviePainter::k_beside + "Frame"] = "3";
    ASSERT_TRUE(verify_picture(file, runs, "test").reasons.empty());
    EXPECT_GT(file.image.height, plain.size_px[1] + 20) << "the caption stands below";
    file.texts[MoviePainter::k_caption] += " and others";
    EXPECT_FALSE(verify_picture(file, runs, "test").reasons.empty()) << "every word counts";
}

TEST_F(Verify, RefusesPicturesThatCannotBeDrawnAgain) {
    make_movie(run_, settings_);
    PngFile file = picture(1);
    file.texts["Frame"] = "99";
    EXPECT_NE(refusal(file, run_).find("frame 99, the run has only 4"), std::string::npos);
    file.texts["Frame"] = "first";
    EXPECT_NE(refusal(file, run_).find("wants a number, got 'first'"), std::string::npos);
    file = picture(1);
    file.texts["Scene"] = "title = \"Another\"\n";
    EXPECT_NE(refusal(file, run_).find("its Scene is another one"), std::string::npos);
    file = picture(1);
    file.texts.erase(k_view_key);
    EXPECT_NE(refusal(file, run_).find("does not say how it was drawn"), std::string::npos);
    file.texts[k_view_key] = "{\"name\":1}";
    EXPECT_NE(refusal(file, run_).find("description cannot be read"), std::string::npos);
}

}  // namespace
}  // namespace spheroscope::render
