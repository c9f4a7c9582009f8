#include "engine/scene/shots.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace spheroscope::scene {
namespace {

TEST(Shots, AreReadInTheirOrderWithTheirUnits) {
    Picture picture;
    picture.shots = {"play to 500 ms", "cutaway on", "freeze 0.1 min, orbit 90 deg",
                     "cutaway off",    "freeze 2 s", "play to end"};
    const std::vector<Shot> shots = parse_shots(picture);
    ASSERT_EQ(shots.size(), 6U);
    EXPECT_EQ(shots[0].kind, Shot::Kind::play);
    EXPECT_EQ(shots[0].until_s, 0.5);
    EXPECT_EQ(shots[1].kind, Shot::Kind::cutaway);
    EXPECT_TRUE(shots[1].has_cutaway);
    EXPECT_EQ(shots[2].kind, Shot::Kind::freeze);
    EXPECT_DOUBLE_EQ(shots[2].movie_s, 6.0);
    EXPECT_EQ(shots[2].orbit_deg, 90.0);
    EXPECT_FALSE(shots[3].has_cutaway);
    EXPECT_EQ(shots[4].orbit_deg, 0.0);
    EXPECT_TRUE(std::isinf(shots[5].until_s));
    EXPECT_TRUE(parse_shots(Picture{}).empty());
}

}  // namespace
}  // namespace spheroscope::scene
