// The program as a shell sees it: what it writes where, and with which code it ends.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <sys/wait.h>
#include <unistd.h>

namespace spheroscope {
namespace {

namespace fs = std::filesystem;

struct Outcome {
    int code;
    std::string out, err;
};

std::string read_text(const fs::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// A folder of its own for every test, with a space in its name; gone when the test is over.
class Binary : public testing::Test {
  protected:
    Binary() { fs::create_directories(folder_); }
    ~Binary() override { fs::remove_all(folder_); }

    /// Runs build/spheroscope in the folder; `arguments` as one would type them.
    Outcome call(const std::string& arguments) {
        const std::string command = "cd '" + folder_.string() +
                                    "' && '" SPHEROSCOPE_BINARY_DIR "/spheroscope' " + arguments;
        const int status = std::system(
            ("(" + command + ") >'" + out_.string() + "' 2>'" + err_.string() + "' </dev/null")
                .c_str());
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_text(out_), read_text(err_)};
    }
    void write_file(const std::string& name, const std::string& text) {
        std::ofstream(folder_ / name) << text;
    }
    static fs::path scenes_folder() { return fs::path(SPHEROSCOPE_SOURCE_DIR) / "scenes"; }
    static std::string drop_scene() {
        return "'" + (scenes_folder() / "claims" / "drop_laplace.toml").string() + "'";
    }

  private:
    const fs::path folder_ =
        fs::path(testing::TempDir()) / ("spheroscope test " + std::to_string(getpid()));
    const fs::path out_ = folder_ / "out.txt";
    const fs::path err_ = folder_ / "err.txt";
};

TEST_F(Binary, NamesItsVersionOnStdout) {
    const Outcome outcome = call("--version");
    EXPECT_EQ(outcome.code, 0);
    EXPECT_EQ(outcome.out.rfind("spheroscope 0.", 0), 0U) << outcome.out;
    EXPECT_EQ(outcome.err, "");
}

TEST_F(Binary, EndsWithTwoAfterAMistypedVerbAndSaysNothingOnStdout) {
    const Outcome outcome = call("chek a.toml");
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.err, "error: unknown verb 'chek'; did you mean 'check'?\n"
                           "  hint: spheroscope --help lists the verbs\n");
}

TEST_F(Binary, SaysSoWhenItsResultCannotBeWritten) {
    const Outcome outcome = call("--help >/dev/full");
    EXPECT_EQ(outcome.code, 5);
    EXPECT_EQ(outcome.err.rfind("error: the result could not be written to stdout\n", 0), 0U)
        << outcome.err;
}

TEST_F(Binary, WhatCheckPrintsAsResolvedIsASceneThatResolvesToItself) {
    const Outcome first = call("check " + drop_scene() + " --print-config");
    EXPECT_EQ(first.code, 0) << first.err;
    write_file("resolved.toml", first.out);
    const Outcome second = call("check resolved.toml --print-config");
    EXPECT_EQ(second.code, 0) << second.err;
    EXPECT_EQ(second.out, first.out);
    EXPECT_FALSE(first.out.empty());
}

TEST_F(Binary, CheckTakesChangesFromTheCommandLine) {
    const Outcome outcome = call("check " + drop_scene() + " --set cells.nodes=42 --seed 9 --json");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const auto document = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(document["valid"], true);
    EXPECT_EQ(document["nodes_per_cell"], 42);
    EXPECT_EQ(document["seed"], 9);
}

TEST_F(Binary, CheckSaysWhatTheSceneHasChosenWhereThePaperLeavesAChoice) {
    const std::string paper = std::string(SPHEROSCOPE_SOURCE_DIR) + "/scenes/paper/";
    const Outcome traction = call("check " + paper + "case_a.toml");
    EXPECT_EQ(traction.code, 0) << traction.err;
    EXPECT_NE(traction.out.find("\n  contact: law = \"traction\", reject_cos = 0, omega_reading = "
                                "\"text\", W = 0.5 nN/um\n"),
              std::string::npos)
        << traction.out;
    const Outcome variational = call("check " + paper + "case_a_variational.toml");
    EXPECT_NE(variational.out.find("law = \"variational\", omega_reading"), std::string::npos)
        << variational.out;
}

TEST_F(Binary, CheckNamesThePlaceOfAMistakeInTextAndJson) {
    write_file("wrong.toml", "[scene]\ntitle = \"a\"\nsed = 1\n");
    const Outcome outcome = call("check wrong.toml --json");
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.err.rfind("wrong.toml:3:1: error: ", 0), 0U) << outcome.err;
    const auto document = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(document["valid"], false);
    EXPECT_EQ(document["line"], 3);
}

TEST_F(Binary, ScenesListsEverySceneThatComesWithTheProgram) {
    std::set<std::string> present;
    for (const auto& entry : fs::recursive_directory_iterator(scenes_folder()))
        if (entry.path().extension() == ".toml") present.insert(entry.path().filename());
    const Outcome outcome = call("scenes --json");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    std::set<std::string> listed;
    const auto document = nlohmann::json::parse(outcome.out);
    for (const auto& row : document["scenes"]) {
        EXPECT_NE(row["title"], "") << row;
        listed.insert(fs::path(row["file"].get<std::string>()).filename());
    }
    EXPECT_EQ(listed, present);
}

TEST_F(Binary, ASceneThatDoesNotLoadStaysInTheListWithItsReasonBeside) {
    write_file("wrong.toml", "[scene\n");
    const Outcome outcome = call("scenes .");
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.out, "wrong.toml  (does not load)\n");
    EXPECT_EQ(outcome.err.rfind("wrong.toml:1:", 0), 0U) << outcome.err;
}

}  // namespace
}  // namespace spheroscope
