// Every run says how wrong its end is: in the summary, with --json, and in its file.
#include "tests/cli/program_runner.hpp"
#include "tests/scene/case_a_text.hpp"

#include <fmt/format.h>
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

/// So far apart that they barely touch, and on the mesh of 42 nodes, whose corners stick out
/// farther, much more.
const std::string k_apart =
    with(with(k_doublet, "\"-9.15 um\"", "\"-9.325 um\""), "\"9.15 um\"", "\"9.325 um\"");

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

/// A number as the summary writes it.
std::string shown(double value) { return fmt::format(" {:.5g}", value); }

TEST_F(Accuracy, AnErrorLargerThanItsValueLeavesNoNumberInTheSummaryAndAMarkInJson) {
    const Outcome outcome =
        run(k_apart + "[expect]\ncontact_area = { max = 1000 }\nenergy = { min = 1 }\n");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const std::string block = block_of_errors(outcome.out);
    EXPECT_NE(block.find("  contact_area           not resolved: error "), std::string::npos)
        << block;
    EXPECT_NE(outcome.out.find("\ncontact_area         not resolved\n"), std::string::npos)
        << outcome.out;
    EXPECT_NE(outcome.out.find("\nexpect contact_area           (not resolved) in "),
              std::string::npos)
        << outcome.out;
    const Outcome info = call({"info", "here/run.h5"});
    const nlohmann::json document = json_of(call({"info", "here/run.h5", "--json"}));
    int n_resolved = 0;
    std::set<std::string> not_resolved;
    for (const nlohmann::json& error : document["errors"]) {
        const double value = error["value"];
        if (error["resolved"].get<bool>()) {
            ++n_resolved;
            EXPECT_NE(block.find(shown(value)), std::string::npos) << error << block;
            continue;
        }
        not_resolved.insert(error["measure"]);
        EXPECT_GT(value, 0.0) << error;
        for (const std::string& text : {outcome.out, info.out})
            EXPECT_EQ(text.find(shown(value)), std::string::npos) << error << text;
    }
    EXPECT_GT(n_resolved, 0);
    EXPECT_TRUE(not_resolved.contains("contact_area"));
    EXPECT_FALSE(not_resolved.contains("energy"));
    not_resolved.insert("sigma_h_mean");  // as it is no larger than sigma_h_size
    EXPECT_EQ(document["not_resolved"].get<std::set<std::string>>(), not_resolved);
    EXPECT_TRUE(document["totals"]["contact_area"].is_number()) << "a script may have it";
}

TEST_F(Accuracy, WithoutSecondRunsThereIsNoErrorAndTheSummarySaysWhatOneWouldTake) {
    const Outcome outcome = run(k_doublet.substr(0, k_doublet.find("[measures]")));
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.out.find("+-"), std::string::npos) << outcome.out;
    const std::string block = block_of_errors(outcome.out);
    for (const char* name : {"time", "mesh"})
        EXPECT_NE(block.find(fmt::format("  {0} error not measured: measures.{0}_error = true "
                                         "measures it, with ",
                                         name)),
                  std::string::npos)
            << block;
    const nlohmann::json errors = errors_in_the_file();
    EXPECT_FALSE(errors.empty());
    for (const nlohmann::json& error : errors) {
        for (const char* part : {"error", "time", "mesh", "rest"})
            EXPECT_TRUE(error[part].is_null()) << error;
        EXPECT_TRUE(error["resolved"].get<bool>()) << error;
    }
}

TEST_F(Accuracy, AMethodWithoutATimeHasNoErrorOfTimeStepsToMeasure) {
    const std::string scene = with(k_doublet, "[measures]\ntime_error = true\nmesh_error = true",
                                   "[method]\nname = \"equilibrium\"");
    const Outcome outcome = run(with(scene, "K = \"5 kPa\"", "controller = \"exact\""));
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const std::string block = block_of_errors(outcome.out);
    EXPECT_EQ(block.find("time error"), std::string::npos) << block;
    EXPECT_NE(block.find("mesh error not measured"), std::string::npos) << block;
}

TEST_F(Accuracy, ARunThatShouldComeToRestAndDoesNotSaysWhatMayComeBesideItsErrors) {
    const Outcome outcome =
        run(with(with(k_doublet, "duration = \"0.2 s\"", "until = \"rest\"\ncap = \"0.2 s\""),
                 "mesh_error = true", "mesh_error = false"));
    ASSERT_EQ(outcome.code, 3) << outcome.err;
    EXPECT_NE(block_of_errors(outcome.out).find("; may still change by "), std::string::npos)
        << outcome.out;
    for (const nlohmann::json& error : errors_in_the_file()) {
        EXPECT_GT(error["rest"].get<double>(), 0.0) << error;
        EXPECT_EQ(error["error"], error["time"]) << "what may come is no measured error";
    }
}

}  // namespace
}  // namespace spheroscope
