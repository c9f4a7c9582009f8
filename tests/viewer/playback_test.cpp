#include "engine/base/error.hpp"
#include "viewer/model/playback.hpp"

#include <gtest/gtest.h>

namespace spheroscope::viewer {
namespace {

Playback thirty_frames() {
    Playback playback;
    for (int i = 0; i < 30; ++i) playback.add_frame(0.5 * i);
    return playback;
}

TEST(Playback, HasNoFrameBeforeOneCame) {
    Playback playback;
    playback.step(1);
    playback.go_to_time(3.0);
    playback.toggle_playing();
    playback.advance(1.0, 30.0);
    EXPECT_EQ(playback.frame(), -1);
    EXPECT_FALSE(playback.is_playing());
    playback.add_frame(0.0);
    EXPECT_EQ(playback.frame(), 0);
}

TEST(Playback, StepsEndAtTheFirstAndTheLastFrame) {
    Playback playback = thirty_frames();
    playback.step(-1);
    EXPECT_EQ(playback.frame(), 0);
    playback.step(10);
    EXPECT_EQ(playback.frame(), 10);
    playback.step(100);
    EXPECT_EQ(playback.frame(), 29);
}

TEST(Playback, GoesToTheFrameNearestToATime) {
    Playback playback = thirty_frames();
    playback.go_to_time(5.2);
    EXPECT_EQ(playback.frame(), 10);
    playback.go_to_time(5.3);
    EXPECT_EQ(playback.frame(), 11);
    playback.go_to_time(1e9);
    EXPECT_EQ(playback.frame(), 29);
}

TEST(Playback, PlaysAsFastAsItsSpeedSaysWhateverTheIntervals) {
    Playback playback = thirty_frames();
    playback.set_speed(0.5);
    playback.toggle_playing();
    for (int k = 0; k < 100; ++k) playback.advance(0.01, 30.0);  // 1 s at 15 frames per second
    EXPECT_NEAR(playback.frame(), 15, 1);
    EXPECT_TRUE(playback.is_playing());
}

TEST(Playback, StopsAtTheLastFrameAndBeginsAnewFromThere) {
    Playback playback = thirty_frames();
    playback.toggle_playing();
    playback.advance(100.0, 30.0);
    EXPECT_EQ(playback.frame(), 29);
    EXPECT_FALSE(playback.is_playing());
    playback.toggle_playing();
    EXPECT_EQ(playback.frame(), 0);
    EXPECT_TRUE(playback.is_playing());
}

TEST(Playback, AFrameChosenByHandEndsThePlaying) {
    Playback playback = thirty_frames();
    playback.toggle_playing();
    playback.step(1);
    EXPECT_FALSE(playback.is_playing());
}

TEST(TypedTime, IsSecondsOrHasAUnit) {
    EXPECT_EQ(parse_time_s("12.5"), 12.5);
    EXPECT_EQ(parse_time_s("350 ms"), 0.35);
    EXPECT_EQ(parse_time_s("2 min"), 120.0);
    EXPECT_THROW(static_cast<void>(parse_time_s("soon")), Error);
    EXPECT_THROW(static_cast<void>(parse_time_s("3 um")), Error);
}

}  // namespace
}  // namespace spheroscope::viewer
