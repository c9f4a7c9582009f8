#include "engine/base/team_choice.hpp"

#include <gtest/gtest.h>

namespace spheroscope {
namespace {

constexpr double k_w = TeamChoice::k_window_s;

TEST(TeamChoice, StaysTogetherOnAQuietMachine) {
    TeamChoice choice;
    for (int i = 0; i < 1000; ++i) {
        choice.window(k_w, 1.8 * k_w);
        ASSERT_TRUE(choice.is_together());
    }
}

TEST(TeamChoice, GivesUpATeamThatGetsLessThanOneThread) {
    TeamChoice choice;
    choice.window(k_w, 0.6 * k_w);
    EXPECT_FALSE(choice.is_together());
}

TEST(TeamChoice, KeepsATeamThatGetsMoreThanTheCallerGotAlone) {
    TeamChoice choice;
    choice.window(k_w, 0.9 * k_w);
    ASSERT_FALSE(choice.is_together()) << "less than one core, which one thread would get";
    while (!choice.is_together()) choice.window(k_w, 0.5 * k_w);  // but it gets half a core
    for (int i = 0; i < 50; ++i) {
        choice.window(k_w, 0.9 * k_w);
        ASSERT_TRUE(choice.is_together());
    }
}

TEST(TeamChoice, DoesNotTrustForEverWhatTheCallerOnceGot) {
    TeamChoice choice;
    choice.window(k_w, 0.9 * k_w);
    while (!choice.is_together()) choice.window(k_w, 0.5 * k_w);
    double together_s = 0.0;
    while (choice.is_together()) {
        choice.window(k_w, 0.9 * k_w);
        together_s += k_w;
        ASSERT_LE(together_s, TeamChoice::k_longest_pause_s);
    }
}

/// Seconds alone until the team is tried again.
double pause_s(TeamChoice& choice) {
    choice.window(k_w, 0.3 * k_w);
    double alone_s = 0.0;
    while (!choice.is_together()) {
        choice.window(k_w, k_w);
        alone_s += k_w;
    }
    return alone_s;
}

TEST(TeamChoice, TriesTheTeamAgainAfterPausesThatDouble) {
    TeamChoice choice;
    for (double expected_s = TeamChoice::k_shortest_pause_s;
         expected_s <= TeamChoice::k_longest_pause_s; expected_s *= 2.0)
        EXPECT_NEAR(pause_s(choice), expected_s, 1.5 * k_w);
    EXPECT_NEAR(pause_s(choice), TeamChoice::k_longest_pause_s, 1.5 * k_w) << "and no further";
    choice.window(k_w, 1.8 * k_w);  // the machine is quiet again
    EXPECT_NEAR(pause_s(choice), TeamChoice::k_shortest_pause_s, 1.5 * k_w);
}

}  // namespace
}  // namespace spheroscope
