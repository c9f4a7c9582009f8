// The verb `extract` from the outside: what it writes runs, and has the contact's force.
#include "tests/cli/program_runner.hpp"

#include <nlohmann/json.hpp>

#include <cmath>

namespace spheroscope {
namespace {

using nlohmann::json;

class ExtractVerb : public EngineRunner {
  protected:
    ExtractVerb() { put_run(); }
    [[nodiscard]] json document(const std::vector<std::string>& arguments) const {
        const Outcome outcome = call(arguments);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return json_of(outcome);
    }
    void expect_refused(std::vector<std::string> arguments, const std::string& words) const {
        SCOPED_TRACE(words);
        arguments.insert(arguments.begin(), {"extract", "o/run.h5"});
        const Outcome outcome = call(arguments);
        EXPECT_EQ(outcome.code, 2) << outcome.err;
        EXPECT_EQ(outcome.out, "");
        EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
    }
};

TEST_F(ExtractVerb, SceneItWritesRunsAndBeginsWithTheForceOfTheContact) {
    const json contacts = document({"inspect", "o/run.h5", "--json", "--quiet"});
    const std::string name = contacts["contacts"][0]["contact"];
    const double force_nN = contacts["contacts"][0]["centre_force_nN"];
    const json made = document({"extract", "o/run.h5", "--contact", name, "--duration", "0.1 s",
                                "-o", "pair.toml", "--json"});
    EXPECT_NEAR(made["centre_force_nN"].get<double>(), force_nN, 1e-6 * std::abs(force_nN));
    EXPECT_EQ(names_in("."), (std::vector<std::string>{".err.txt", ".out.txt", "o", "pair.h5",
                                                       "pair.toml", "scene.toml"}));
    EXPECT_EQ(call({"check", "pair.toml"}).code, 0);
    EXPECT_EQ(call({"run", "pair.toml", "-o", "pair", "--quiet", "--threads", "1"}).code, 0);
    const json pair = document({"inspect", "pair/run.h5", "--frame", "0", "--json", "--quiet"});
    ASSERT_EQ(pair["contacts"].size(), 1U);
    EXPECT_NEAR(pair["contacts"][0]["centre_force_nN"].get<double>(), force_nN,
                1e-4 * std::abs(force_nN));
}

TEST_F(ExtractVerb, WrongInputIsRefusedAndNothingIsWritten) {
    expect_refused({"--contact", "0-9"}, "there is no cell 9");
    expect_refused({"--contact", "0-1", "--frame", "0"}, "beads that are being packed");
    expect_refused({"--contact", "0-1", "--duration", "3 um"},
                   "--duration wants a time above zero");
    expect_refused({"--contact", "0-1", "-o", "pair.h5"}, "-o wants the name of a scene (.toml)");
    EXPECT_EQ(names_in("."), (std::vector<std::string>{".err.txt", ".out.txt", "o", "scene.toml"}));
    write_file("pair.toml", "mine");
    expect_refused({"--contact", "0-1", "-o", "pair.toml"},
                   "pair.toml: this file is there already");
}

TEST_F(ExtractVerb, ForcesOnNodesOfAnExtractedPairAreRefusedBecauseTheHeldOnesAreNotInItsFrames) {
    const json contacts = document({"inspect", "o/run.h5", "--json", "--quiet"});
    const std::string name = contacts["contacts"][0]["contact"];
    ASSERT_EQ(call({"extract", "o/run.h5", "--contact", name, "-o", "pair.toml"}).code, 0);
    const Outcome outcome = call({"inspect", "pair.h5", "--node", "0:1"});
    EXPECT_EQ(outcome.code, 2);
    EXPECT_NE(outcome.err.find("[load.held]"), std::string::npos) << outcome.err;
}

TEST_F(ExtractVerb, ARunWithCellsOfAFileIsNotRepeatedWithThoseThatLieWhereItIsCalled) {
    const std::string name =
        document({"inspect", "o/run.h5", "--json", "--quiet"})["contacts"][0]["contact"];
    std::filesystem::create_directories(path("a"));
    ASSERT_EQ(
        call({"extract", "o/run.h5", "--contact", name, "-o", "a/pair.toml", "--duration", "0.1 s"})
            .code,
        0);
    const json run =
        document({"run", "a/pair.toml", "-o", "first", "--quiet", "--threads", "1", "--json"});
    std::filesystem::copy_file(path("o/run.h5"), path("pair.h5"));  // other cells
    const Outcome refused = call({"run", "first/run.h5", "-o", "again", "--quiet"});
    EXPECT_EQ(refused.code, 2);
    EXPECT_NE(refused.err.find("began with the cells of pair.h5"), std::string::npos)
        << refused.err;
    EXPECT_FALSE(std::filesystem::exists(path("again")));
    const json again = document({"run", "first/run.h5", "-o", "again", "--quiet", "--threads", "1",
                                 "--json", "--set", "cells.file=\"a/pair.h5\""});
    EXPECT_EQ(again["state_hash"], run["state_hash"]);
}

TEST_F(ExtractVerb, DoesNotReplaceTheRunThatItReads) {
    const Outcome outcome =
        call({"extract", "o/run.h5", "--contact", "0-1", "-o", "o/run.toml", "--overwrite"});
    EXPECT_EQ(outcome.code, 2);
    EXPECT_NE(outcome.err.find("o/run.h5: this file is read here"), std::string::npos)
        << outcome.err;
    EXPECT_EQ(call({"info", "o/run.h5"}).code, 0);
}

TEST_F(ExtractVerb, LeavesNothingWhereItsSceneCannotBeWritten) {
    const std::string name =
        document({"inspect", "o/run.h5", "--json", "--quiet"})["contacts"][0]["contact"];
    std::filesystem::create_directories(path("pair.toml/taken"));
    EXPECT_EQ(
        call({"extract", "o/run.h5", "--contact", name, "-o", "pair.toml", "--overwrite"}).code, 5);
    EXPECT_EQ(names_in("."),
              (std::vector<std::string>{".err.txt", ".out.txt", "o", "pair.toml", "scene.toml"}));
}

}  // namespace
}  // namespace spheroscope
