// The numbers of scenes/paper/results are those that the program gives: one of its runs is made
// again, and the table of claims follows from the numbers beside it.
#include "engine/claims/claim_table.hpp"
#include "engine/claims/kept_report.hpp"
#include "engine/claims/verdict.hpp"
#include "tests/claims/scene_run.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

namespace spheroscope::test {
namespace {

const std::string k_paper = SPHEROSCOPE_SOURCE_DIR "/scenes/paper";

/// Fields of one line of a CSV file; a field in quotes may have commas.
std::vector<std::string> fields_of(const std::string& line) {
    std::vector<std::string> fields(1);
    bool is_quoted = false;
    for (const char c : line)
        if (c == '"')
            is_quoted = !is_quoted;
        else if (c == ',' && !is_quoted)
            fields.emplace_back();
        else
            fields.back() += c;
    return fields;
}

using CsvRow = std::map<std::string, std::string>;

std::vector<CsvRow> read_csv(const std::string& path) {
    std::ifstream file(path);
    std::vector<CsvRow> rows;
    std::vector<std::string> names;
    for (std::string line; std::getline(file, line);) {
        if (line.empty() || line.front() == '#') continue;
        const std::vector<std::string> fields = fields_of(line);
        if (names.empty()) {
            names = fields;
            continue;
        }
        rows.emplace_back();
        for (std::size_t i = 0; i < fields.size(); ++i) rows.back()[names.at(i)] = fields[i];
    }
    return rows;
}

TEST(StoredResults, AreWhatASmallRunGivesAgain) {
    const claims::ClaimTable table = claims::load_claims(k_paper + "/paper.claims");
    const claims::ClaimedSetup* setup = table.find_setup("a_75_cells");
    ASSERT_NE(setup, nullptr);
    CsvRow stored;
    for (const CsvRow& row : read_csv(k_paper + "/results/runs.csv"))
        if (row.at("setup") == setup->name && row.at("seed") == "1") stored = row;
    ASSERT_FALSE(stored.empty()) << "a run that is in the file";

    std::vector<scene::Override> overrides{{"scene.seed", "1"}};
    for (const std::string& text : setup->settings) {
        const auto equals = text.find('=');
        overrides.push_back({text.substr(0, equals), text.substr(equals + 1)});
    }
    const SceneRun run = run_scene("paper/" + setup->scene, overrides);
    EXPECT_EQ(run.result.outcome, stored.at("outcome"));
    // Processors round differently, and what rests here may rest a step later there.
    const std::map<std::string, double> tolerances{{"R_th", 1e-3},
                                                   {"contact_fraction", 2e-3},
                                                   {"coordination_Z", 0.06},
                                                   {"sigma_h_rim", 4e-4},
                                                   {"sigma_h_core", 4e-4},
                                                   {"volume_error", 5e-4},
                                                   {"smallest_triangle", 0.02}};
    for (const auto& [name, tolerance] : tolerances)
        EXPECT_NEAR(value_of(*find_total(name), run.last().totals), std::stod(stored.at(name)),
                    tolerance)
            << name;
}

/// Derived again from numbers.csv and runs.csv: what claims.csv says of each claim.
TEST(StoredResults, HaveTheVerdictsThatFollowFromTheirNumbers) {
    const claims::ClaimTable table = claims::load_claims(k_paper + "/paper.claims");
    const claims::MeasuredSetups numbers = claims::kept_setups(k_paper + "/results");
    std::map<std::string, CsvRow> stored;
    for (const CsvRow& row : read_csv(k_paper + "/results/claims.csv"))
        stored[row.at("claim")] = row;
    EXPECT_EQ(stored.size(), table.claims.size());
    int n_judged = 0;
    for (const claims::JudgedClaim& judged : claims::judge_claims(table, numbers)) {
        const claims::Claim& claim = *judged.claim;
        SCOPED_TRACE(claim.id);
        ASSERT_TRUE(stored.contains(claim.id));
        const CsvRow& row = stored.at(claim.id);
        EXPECT_EQ(row.at("says"), claim.says);
        EXPECT_EQ(row.at("source"), claim.source);
        EXPECT_EQ(row.at("remark"), claim.remark);
        EXPECT_EQ(row.at("paper"), claim.paper.text());
        EXPECT_EQ(row.at("verdict"), claims::name_of(judged.verdict));
        EXPECT_EQ(row.at("reason"), judged.reason);
        if (std::isnan(judged.value.mean)) {
            EXPECT_EQ(row.at("mean"), "-");
            continue;
        }
        EXPECT_DOUBLE_EQ(std::stod(row.at("mean")), judged.value.mean);
        if (!std::isnan(judged.value.standard_error)) {
            EXPECT_DOUBLE_EQ(std::stod(row.at("standard_error")), judged.value.standard_error);
        }
        EXPECT_EQ(std::stoi(row.at("seeds")), judged.value.n);
        ++n_judged;
    }
    EXPECT_GT(n_judged, 100);
}

}  // namespace
}  // namespace spheroscope::test
