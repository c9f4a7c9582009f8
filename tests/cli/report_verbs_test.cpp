// The verbs that print reports, as a script sees them.
#include "tests/cli/program_runner.hpp"
#include "tests/reports/stretched_cell.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>

namespace spheroscope {
namespace {

const std::string k_stretched_cell = stretched_cell_text("0.032 s", "dt = \"4 ms\"\n");

class ReportVerbs : public EngineRunner {
  protected:
    ReportVerbs() { write_file("small.toml", k_stretched_cell); }
    [[nodiscard]] std::vector<std::string> lines_of(const std::string& name) const {
        std::ifstream file(path(name));
        std::vector<std::string> lines;
        for (std::string line; std::getline(file, line);) lines.push_back(line);
        return lines;
    }
};

TEST_F(ReportVerbs, PrecisionGivesOneObjectForEachRunWithWhatScriptsRelyOn) {
    const Outcome outcome = call({"precision", "small.toml", "--levels", "2", "--json", "--quiet"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const auto document = json_of(outcome);
    ASSERT_GE(document["runs"].size(), 4U);
    for (const auto& run : document["runs"]) {
        for (const char* key : {"method", "setting", "errors", "wall_s", "work", "hash", "outcome"})
            EXPECT_TRUE(run.contains(key)) << key;
        for (const char* key :
             {"positions", "volume", "gamma_eff", "sigma_h", "contact_area", "pair_force"})
            EXPECT_TRUE(run["errors"].contains(key)) << key;
        EXPECT_TRUE(run["errors"]["contact_area"].is_null()) << "one cell touches nothing";
        EXPECT_EQ(run["hash"].get<std::string>().size(), 16U);
    }
    EXPECT_TRUE(document["reference"]["errors"]["positions"].is_number());
}

TEST_F(ReportVerbs, PrecisionWritesATableWithOneLineForEachRun) {
    const Outcome outcome = call({"precision", "small.toml", "--levels", "2", "-o", "here"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    std::size_t n_rows = 0, n_columns = 0;
    for (const std::string& line : lines_of("here/precision.csv")) {
        if (line.front() == '#') continue;
        ++n_rows;
        if (n_columns == 0)
            n_columns = static_cast<std::size_t>(std::count(line.begin(), line.end(), ','));
        if (line.find('"') != std::string::npos) continue;  // a text with commas of its own
        EXPECT_EQ(static_cast<std::size_t>(std::count(line.begin(), line.end(), ',')), n_columns);
    }
    EXPECT_GE(n_rows, 5U);
    EXPECT_NE(outcome.out.find("\nreference: "), std::string::npos) << outcome.out;
    // The table alone says what its errors are against, and how good that is.
    const std::vector<std::string> lines = lines_of("here/precision.csv");
    const auto has = [&](const std::string& begin) {
        return std::any_of(lines.begin(), lines.end(),
                           [&](const std::string& line) { return line.starts_with(begin); });
    };
    EXPECT_TRUE(has("# reference: "));
    for (const char* measure : {"positions", "volume", "gamma_eff"})
        EXPECT_TRUE(has(std::string("#   ") + measure + " ")) << measure;
}

TEST_F(ReportVerbs, PrecisionShowsAMethodThatFailsAsFailed) {
    const Outcome outcome = call({"precision", "small.toml", "--levels", "1", "--json", "--quiet",
                                  "--set", "cortex.elastic.E=2000", "--set", "method.dt=32 ms"});
    const auto document = json_of(outcome);
    const auto& run = document["runs"][0];
    EXPECT_EQ(run["method"], "forward_euler");
    EXPECT_EQ(run["outcome"], "failed");
    EXPECT_NE(run["message"], "");
    for (const auto& error : run["errors"]) EXPECT_TRUE(error.is_null());
}

TEST_F(ReportVerbs, PrecisionEndsWithThreeWhenTheTimeLimitComesFirst) {
    const Outcome outcome =
        call({"precision", "small.toml", "--quiet", "--time-limit", "1 us", "--json"});
    EXPECT_EQ(outcome.code, 3) << outcome.err;
    EXPECT_EQ(json_of(outcome)["met_time_limit"], true);
}

TEST_F(ReportVerbs, PrecisionRefusesASceneThatEndsOnACondition) {
    write_file("rest.toml", with(k_stretched_cell, "duration = \"0.032 s\"", "until = \"rest\""));
    const Outcome outcome = call({"precision", "rest.toml"});
    EXPECT_EQ(outcome.code, 2);
    EXPECT_NE(outcome.err.find("rest.toml:"), std::string::npos) << outcome.err;
}

TEST_F(ReportVerbs, PrecisionWithMeshLevelsSaysWhichErrorDominates) {
    const Outcome outcome =
        call({"precision", "small.toml", "--mesh", "--most-nodes", "642", "--json", "--quiet"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const auto document = json_of(outcome);
    EXPECT_EQ(document["levels"].size(), 3U);
    for (const auto& measure : document["measures"])
        for (const char* key : {"values", "extrapolated", "order", "mesh_error",
                                "mesh_error_is_rough", "time_error", "dominant"})
            EXPECT_TRUE(measure.contains(key)) << key;
}

}  // namespace
}  // namespace spheroscope
