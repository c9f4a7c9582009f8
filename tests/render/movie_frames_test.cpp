#include "render/movie_frames.hpp"

#include <gtest/gtest.h>

namespace spheroscope::render {
namespace {

std::vector<int> numbers(const std::vector<MovieFrame>& frames) {
    std::vector<int> result;
    for (const MovieFrame& frame : frames) result.push_back(frame.frame);
    return result;
}

TEST(MovieFrames, WithoutShotsAreEachFrameOnce) {
    const std::vector<MovieFrame> frames = movie_frames({}, std::vector{0.0, 0.0, 1.0});
    EXPECT_EQ(numbers(frames), (std::vector{0, 1, 2}));
    EXPECT_EQ(frames[1].progress, 0.5);
    EXPECT_EQ(frames[2].progress, 1.0);
}

TEST(MovieFrames, AShotThatPlaysNothingNewIsNoPicture) {
    scene::Picture picture;
    picture.fps = 2.0;
    picture.shots = {"play to 0.1 s", "play to 0.2 s", "freeze 1 s", "play to 3 s"};
    EXPECT_EQ(numbers(movie_frames(picture, std::vector{0.0, 1.0, 2.0, 5.0})),
              (std::vector{0, 0, 0, 1, 2}));
}

TEST(MovieFrames, SayWhichShotsLieBeyondTheEnd) {
    scene::Picture picture;
    picture.name = "main";
    picture.shots = {"play to 1 s", "freeze 1 s", "play to 2 s", "play to 400 s", "play to end"};
    const std::vector<std::string> remarks = shots_beyond_the_end(picture, 2.0 - 1e-12);
    ASSERT_EQ(remarks.size(), 1U);
    EXPECT_EQ(remarks[0], "picture 'main': a shot plays to 400 s, and the run ends at 2 s");
    EXPECT_TRUE(shots_beyond_the_end({}, 2.0).empty());
}

TEST(FramesBeside, AreTheLastThatAreNotLater) {
    const std::vector times{0.0, 0.0, 0.0, 1.0, 2.0, 3.0};
    EXPECT_EQ(frames_beside(times, times), (std::vector{0, 1, 2, 3, 4, 5}));
    EXPECT_EQ(frames_beside(times, std::vector{0.0, 0.5, 2.5}), (std::vector{0, 0, 0, 1, 1, 2}));
    EXPECT_EQ(frames_beside(times, std::vector{0.0, 0.0, 0.0, 0.0, 4.0}),
              (std::vector{0, 1, 2, 3, 3, 3}));
}

}  // namespace
}  // namespace spheroscope::render
