#include "engine/base/error.hpp"

#include <gtest/gtest.h>

#include <string>

namespace spheroscope {
namespace {

TEST(Loc, ReadsAsFileLineColumn) {
    EXPECT_EQ((Loc{"scenes/a.toml", 14, 7}.text()), "scenes/a.toml:14:7");
}

TEST(Loc, WithoutALineIsTheWholeFile) {
    EXPECT_EQ((Loc{"scenes/a.toml", 0, 0}.text()), "scenes/a.toml");
}

TEST(Loc, WithoutAFileIsEmpty) { EXPECT_EQ((Loc{"", 14, 7}.text()), ""); }

TEST(Error, MessageNamesThePlaceFirstAndTheHintLast) {
    const Error error(Loc{"a.toml", 3, 1}, "wanted a length, got \"red\"", "for instance 9 um");
    EXPECT_EQ(std::string(error.what()),
              "a.toml:3:1: error: wanted a length, got \"red\"\n  hint: for instance 9 um");
    EXPECT_EQ(error.loc().line, 3);
}

TEST(Error, WithoutPlaceOrHintIsTheBareMessage) {
    EXPECT_EQ(std::string(Error("there is no ffmpeg").what()), "error: there is no ffmpeg");
}

TEST(Error, IsTheUsersMistakeUnlessItSaysOtherwise) {
    EXPECT_EQ(Error("wrong").code(), ExitCode::usage);
    EXPECT_EQ(Error("no ffmpeg", "", ExitCode::environment).code(), ExitCode::environment);
}

// The numbers are a promise to scripts (README, 'Exit codes').
TEST(ExitCodes, AreTheDocumentedNumbers) {
    EXPECT_EQ(static_cast<int>(ExitCode::ok), 0);
    EXPECT_EQ(static_cast<int>(ExitCode::internal), 1);
    EXPECT_EQ(static_cast<int>(ExitCode::usage), 2);
    EXPECT_EQ(static_cast<int>(ExitCode::not_converged), 3);
    EXPECT_EQ(static_cast<int>(ExitCode::differs), 4);
    EXPECT_EQ(static_cast<int>(ExitCode::environment), 5);
    EXPECT_EQ(static_cast<int>(ExitCode::interrupted), 130);
    EXPECT_EQ(static_cast<int>(ExitCode::terminated), 143);
}

#if !defined(NDEBUG) || defined(SPHEROSCOPE_CHECKS)
TEST(AssertionDeathTest, EndsTheProgramAndNamesFileConditionAndValues) {
    testing::FLAGS_gtest_death_test_style = "threadsafe";
    const int n_nodes = 41;
    EXPECT_DEATH(SPHEROSCOPE_ASSERT(n_nodes == 42, "n_nodes " + std::to_string(n_nodes)),
                 "error_test.cpp:[0-9]+: internal error: 'n_nodes == 42' does not hold: "
                 "n_nodes 41");
}
#else
TEST(Assertion, CostsNothingWhereChecksAreOff) {
    int evaluations = 0;
    SPHEROSCOPE_ASSERT(++evaluations > 1, "never evaluated");
    EXPECT_EQ(evaluations, 0);
}
#endif

}  // namespace
}  // namespace spheroscope
