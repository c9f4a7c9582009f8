#include "engine/cli/options.hpp"
#include "engine/cli/program.hpp"

#include <gtest/gtest.h>

#include <cerrno>
#include <cstdio>
#include <memory>
#include <new>
#include <system_error>

namespace spheroscope::cli {
namespace {

/// What came out of a call of the program.
struct Outcome {
    ExitCode code;
    std::string out, err;
};

/// A verb that does nothing but what the test says.
Verb made_up_verb(const std::string& name, const VerbAction& action) {
    return {name, "made up for the test", [action](CommandLine& command) {
                const auto common = std::make_shared<CommonOptions>();
                add_common_options(command, *common, {CommonOption::json, CommonOption::threads});
                return VerbAction(
                    [action, common](const Invocation& invocation) { return action(invocation); });
            }};
}

const VerbAction k_nothing = [](const Invocation&) { return ExitCode::ok; };

Outcome call(const std::vector<std::string>& arguments, const VerbAction& action = k_nothing) {
    const std::vector<Verb> verbs{made_up_verb("movie", action), made_up_verb("check", action)};
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    const ExitCode code = run_program(arguments, verbs, "1.2.3 (abc)");
    std::fflush(stdout);
    std::fflush(stderr);
    return {code, testing::internal::GetCapturedStdout(), testing::internal::GetCapturedStderr()};
}

TEST(Program, HelpListsEveryVerbWithItsLineOnStdout) {
    const Outcome help = call({"--help"});
    EXPECT_EQ(help.code, ExitCode::ok);
    EXPECT_NE(help.out.find("movie       made up for the test\n"), std::string::npos) << help.out;
    EXPECT_NE(help.out.find("check       made up for the test\n"), std::string::npos) << help.out;
    EXPECT_EQ(help.err, "");
}

TEST(Program, WithoutArgumentsItShowsTheHelpOnStderrAsAMistake) {
    const Outcome help = call({});
    EXPECT_EQ(help.code, ExitCode::usage);
    EXPECT_EQ(help.out, "");
    EXPECT_EQ(help.err, call({"--help"}).out);
}

TEST(Program, VersionIsOneLineOnStdout) {
    const Outcome version = call({"--version"});
    EXPECT_EQ(version.code, ExitCode::ok);
    EXPECT_EQ(version.out, "spheroscope 1.2.3 (abc)\n");
}

TEST(Program, AMistypedVerbGetsAProposal) {
    const Outcome outcome = call({"moive"});
    EXPECT_EQ(outcome.code, ExitCode::usage);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.err, "error: unknown verb 'moive'; did you mean 'movie'?\n"
                           "  hint: spheroscope --help lists the verbs\n");
}

TEST(Program, AVerbLikeNoOtherGetsNoProposal) {
    EXPECT_EQ(call({"frobnicate"}).err, "error: unknown verb 'frobnicate'\n"
                                        "  hint: spheroscope --help lists the verbs\n");
}

TEST(Program, AMistypedOptionGetsAProposal) {
    const Outcome outcome = call({"check", "--jsn"});
    EXPECT_EQ(outcome.code, ExitCode::usage);
    EXPECT_EQ(outcome.err, "error: unknown option '--jsn'; did you mean '--json'?\n"
                           "  hint: spheroscope check --help lists what the verb takes\n");
}

TEST(Program, AnArgumentTooManyIsAMistake) {
    const Outcome outcome = call({"check", "a.toml"});
    EXPECT_EQ(outcome.code, ExitCode::usage);
    EXPECT_EQ(outcome.err.rfind("error: unexpected argument 'a.toml'\n", 0), 0U) << outcome.err;
}

TEST(Program, ThreadsBelowOneAreRefused) {
    const Outcome outcome = call({"check", "--threads", "0"});
    EXPECT_EQ(outcome.code, ExitCode::usage);
    EXPECT_NE(outcome.err.find("--threads"), std::string::npos) << outcome.err;
}

TEST(Program, AVerbsOwnHelpNamesItsOptions) {
    const Outcome help = call({"check", "--help"});
    EXPECT_EQ(help.code, ExitCode::ok);
    EXPECT_NE(help.out.find("--threads"), std::string::npos) << help.out;
}

TEST(Program, TheExitCodeOfTheVerbIsThatOfTheProgram) {
    const Outcome outcome = call({"movie"}, [](const Invocation&) { return ExitCode::differs; });
    EXPECT_EQ(outcome.code, ExitCode::differs);
}

TEST(Program, AnErrorBecomesItsMessageAndItsExitCode) {
    const Outcome outcome = call({"movie"}, [](const Invocation&) -> ExitCode {
        throw Error("there is no ffmpeg", "apt install ffmpeg", ExitCode::environment);
    });
    EXPECT_EQ(outcome.code, ExitCode::environment);
    EXPECT_EQ(outcome.err, "error: there is no ffmpeg\n  hint: apt install ffmpeg\n");
    EXPECT_EQ(outcome.out, "");
}

TEST(Program, AnyOtherExceptionIsAnInternalError) {
    const Outcome outcome = call(
        {"movie"}, [](const Invocation&) -> ExitCode { throw std::out_of_range("vector::at"); });
    EXPECT_EQ(outcome.code, ExitCode::internal);
    EXPECT_EQ(outcome.err.rfind("internal error: vector::at\n", 0), 0U) << outcome.err;
}

TEST(Program, WhatTheSystemRefusesIsNotCalledAMistakeOfTheProgram) {
    const Outcome outcome = call({"movie"}, [](const Invocation&) -> ExitCode {
        throw std::system_error(ENOSPC, std::generic_category(), "out/a.png");
    });
    EXPECT_EQ(outcome.code, ExitCode::environment);
    EXPECT_EQ(outcome.err, "error: out/a.png: No space left on device\n");
}

TEST(Program, WantOfMemoryIsNotCalledAMistakeOfTheProgram) {
    const Outcome outcome =
        call({"movie"}, [](const Invocation&) -> ExitCode { throw std::bad_alloc(); });
    EXPECT_EQ(outcome.code, ExitCode::environment);
    EXPECT_EQ(outcome.err, "error: out of memory\n");
}

TEST(Program, TheVerbLearnsTheCommandLineAsAShellWouldTakeIt) {
    std::string seen;
    static_cast<void>(call({"check", "--threads", "2"}, [&](const Invocation& invocation) {
        seen = invocation.command_line;
        return ExitCode::ok;
    }));
    EXPECT_EQ(seen, "spheroscope check --threads 2");
    EXPECT_EQ(command_line_text({"run", "my scene.toml", "--set", "title=it's", ""}),
              "spheroscope run 'my scene.toml' --set 'title=it'\\''s' ''");
}

}  // namespace
}  // namespace spheroscope::cli
