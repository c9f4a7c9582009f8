// Every run says how wrong its end is: in the summary, with --json, and in its file.
#include "tests/cli/program_runner.hpp"
#include "tests/scene/case_a_text.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <set>
#include <sstream>

namespace spheroscope {
namespace {

/// Two cells in the moment of their first contact, three runs of it in a tenth of a second.
const std::string k_doublet = R"([scene]
title = "Two cells that touch"
[cells]
arrangement = "centres"
nodes = 162
centres = [[0, 0, "-9.15 um", "9 um"], [0, 0, "9.15 um", "9 um"]]
)" + k_case_a_cell + case_a_contact() +
                              R"([[stage]]
kind = "relax"
duration = "0.2 s"
every = "0.05 s"
[measures]
time_error = true
mesh_error = true
)";

/// So far apart that they touch on the mesh of 42 nodes alone, whose corners stick out farther.
const std::string k_apart =
    with(with(k_doublet, "\"-9.15 um\"", "\"-9.33 um\""), "\"9.15 um\"", "\"9.33 um\"");

class Accuracy : public EngineRunner {
  protected:
    [[nodiscard]] Outcome run(const std::string& scene) const {
        write_file("doublet.toml", scene);
        return call({"run", "doublet.toml", "--threads", "1", "--quiet", "-o", "here"});
    }
    [[nodiscard]] nlohmann::json errors_in_the_file() const {
        const Outcome info = call({"info", "here/run.h5", "--json"});
        EXPECT_EQ(info.code, 0) << info.err;
        return json_of(info)["errors"];
    }
};

/// From "estimated errors of the end" on to what is not indented any more.
std::string block_of_errors(const std::string& text) {
    std::istringstream lines(text.substr(text.find("estimated errors of the end:\n")));
    std::string block, line;
    std::getline(lines, line);
    while (std::getline(lines, line) && line.starts_with("  ")) block += line + "\n";
    return block;
}

TEST_F(Accuracy, IsTheSameInTheSummaryInJsonAndInTheFile) {
    const Outcome in_words = run(k_doublet);
    ASSERT_EQ(in_words.code, 0) << in_words.err;
    const std::string block = block_of_errors(in_words.out);
    ASSERT_FALSE(block.empty()) << in_words.out;
    EXPECT_EQ(block_of_errors(call({"info", "here/run.h5"}).out), block);

    const nlohmann::json errors = errors_in_the_file();
    const Outcome as_json =
        call({"run", "doublet.toml", "--threads", "1", "--quiet", "--json", "-o", "there"});
    ASSERT_EQ(as_json.code, 0) << as_json.err;
    EXPECT_EQ(json_of(as_json)["errors"], errors);

    std::set<std::string> measures;
    for (const nlohmann::json& error : errors) {
        measures.insert(error["measure"]);
        // Both second runs have been made, and the parts add up to what is printed.
        EXPECT_EQ(error["time_is_measured"], true) << error;
        const double time = error["time"], mesh = error["mesh"], total = error["error"];
        EXPECT_TRUE(error["rest"].is_null()) << "nobody asked for rest";
        EXPECT_GT(time, 0.0) << error;
        EXPECT_GT(mesh, 0.0) << error;
        EXPECT_NEAR(total, std::hypot(time, mesh), 1e-12 * total) << error;
        EXPECT_EQ(error["resolved"], error["error"] <= std::abs(error["value"].get<double>()));
        const std::string name = error["measure"], advice = error["advice"];
        EXPECT_FALSE(advice.empty()) << error;
        EXPECT_NE(block.find("  " + name + " "), std::string::npos) << block;
    }
    EXPECT_TRUE(measures.contains("contact_area") && measures.contains("energy"));
    // The largest of all ends the block, with what would halve it.
    const std::string last = block.substr(block.find("  largest: "));
    const std::string largest = last.substr(11, last.find(';') - 11);
    for (const nlohmann::json& error : errors)
        if (error["measure"] == largest) {
            EXPECT_EQ(last,
                      "  largest: " + largest + "; " + error["advice"].get<std::string>() + "\n");
        }
    EXPECT_TRUE(measures.contains(largest)) << last;
}

TEST_F(Accuracy, AnErrorLargerThanItsValueIsNotResolved) {
    const Outcome outcome = run(k_apart);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const std::string block = block_of_errors(outcome.out);
    EXPECT_NE(block.find("  contact_area       not resolved: error "), std::string::npos) << block;
    EXPECT_NE(block.find("  energy             10"), std::string::npos) << block;
    int n_resolved = 0, n_unresolved = 0;
    for (const nlohmann::json& error : errors_in_the_file()) {
        ++(error["resolved"].get<bool>() ? n_resolved : n_unresolved);
        if (error["measure"] == "contact_area") {
            EXPECT_EQ(error["resolved"], false) << error;
        }
        if (error["measure"] == "energy") {
            EXPECT_EQ(error["resolved"], true) << error;
        }
    }
    EXPECT_GT(n_resolved, 0);
    EXPECT_GT(n_unresolved, 0);
}

TEST_F(Accuracy, WithoutSecondRunsTheErrorOfTheStepsIsMarkedAsAGuessAndThatOfTheMeshIsUnknown) {
    const Outcome outcome = run(k_doublet.substr(0, k_doublet.find("[measures]")));
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const std::string block = block_of_errors(outcome.out);
    EXPECT_NE(block.find("(time ~"), std::string::npos) << block;
    EXPECT_NE(block.find("  ~: a guess"), std::string::npos) << block;
    EXPECT_EQ(block.find("mesh "), std::string::npos) << block;
    for (const nlohmann::json& error : errors_in_the_file()) {
        EXPECT_EQ(error["time_is_measured"], false) << error;
        EXPECT_TRUE(error["mesh"].is_null()) << error;
    }
}

TEST_F(Accuracy, ARunThatShouldComeToRestAndDoesNotCountsWhatIsLeft) {
    const Outcome outcome =
        run(with(with(k_doublet, "duration = \"0.2 s\"", "until = \"rest\"\ncap = \"0.2 s\""),
                 "mesh_error = true", "mesh_error = false"));
    ASSERT_EQ(outcome.code, 3) << outcome.err;
    EXPECT_NE(block_of_errors(outcome.out).find(", rest "), std::string::npos) << outcome.out;
    for (const nlohmann::json& error : errors_in_the_file()) {
        const double time = error["time"], rest = error["rest"], total = error["error"];
        EXPECT_GT(rest, 0.0) << error;
        EXPECT_NEAR(total, std::hypot(time, rest), 1e-12 * total) << error;
    }
}

}  // namespace
}  // namespace spheroscope
