// What a report writes of its setups can be read again.
#include "engine/base/error.hpp"
#include "engine/claims/kept_report.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

namespace spheroscope::claims {
namespace {

constexpr double k_nan = std::numeric_limits<double>::quiet_NaN();

class KeptReport : public testing::Test {
  protected:
    KeptReport() { std::filesystem::create_directories(folder); }
    ~KeptReport() override { std::filesystem::remove_all(folder); }
    KeptReport(const KeptReport&) = delete;
    KeptReport& operator=(const KeptReport&) = delete;
    void write(const std::string& name, const std::string& text) const {
        std::ofstream(folder + "/" + name) << text;
    }
    void write(const MeasuredSetups& measured) const {
        write("numbers.csv", numbers_report(measured).csv_text({"some, comment"}));
        write("runs.csv", runs_report(measured).csv_text(
                              {"soft, seed 2 ended at its cap", "softer, seed 1 failed"}));
    }
    std::string refusal() const {
        try {
            static_cast<void>(kept_setups(folder));
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    }
    const std::string folder = testing::TempDir() + "/kept_report";
};

TEST_F(KeptReport, HasEverythingThatClaimsAreJudgedBy) {
    MeasuredSetups measured;
    MeasuredSetup& soft = measured["soft"];
    soft.law = "traction";
    soft.n_cells = 150;
    soft.n_nodes = 162;
    soft.numbers = {{"coordination_Z", "1", {9.5, 0.1 / 3.0, 2}, {9.4, 9.6}},
                    {"depth, of the \"zero\"", "um", {12.5, k_nan, 1}, {k_nan, 12.5}},
                    {"beta", "1", {1.25, 0.05, 2}, {}}};
    Totals totals{};
    totals.contact_fraction = 1.0 / 3.0;
    totals.n_folds = 7;
    totals.probe_way_um = k_nan;
    soft.runs = {{1, "rest", "0.1", 300.0, 15.5, totals, "00000000deadbeef"},
                 {2, "cap", "0.1", 600.0, 30.0, totals, ""}};
    soft.runs[0].last_dt_s = 1.0 / 3.0;
    MeasuredSetup& beads = measured["beads"];
    beads.law = "-";
    beads.n_cells = 1000;
    beads.numbers = {{"jamming_fraction", "1", {0.648, 0.001, 1}, {0.648}}};
    beads.runs = {{1, "jammed", "0.1", 0.0, 20.0, {}, ""}};
    write(measured);

    const MeasuredSetups kept = kept_setups(folder);
    ASSERT_EQ(kept.size(), 2U);
    const MeasuredSetup& again = kept.at("soft");
    EXPECT_EQ(again.law, "traction");
    EXPECT_EQ(again.n_cells, 150);
    EXPECT_EQ(again.n_nodes, 162);
    EXPECT_EQ(again.remarks, (std::vector<std::string>{"seed 2 ended at its cap"}));
    ASSERT_EQ(again.numbers.size(), 3U);
    EXPECT_EQ(again.numbers[0].estimate.standard_error, 0.1 / 3.0) << "every digit";
    EXPECT_EQ(again.numbers[0].by_run, soft.numbers[0].by_run);
    EXPECT_EQ(again.numbers[1].name, soft.numbers[1].name);
    EXPECT_TRUE(std::isnan(again.numbers[1].estimate.standard_error));
    ASSERT_EQ(again.numbers[1].by_run.size(), 2U);
    EXPECT_TRUE(std::isnan(again.numbers[1].by_run[0]));
    EXPECT_TRUE(again.numbers[2].by_run.empty()) << "of all runs together";
    ASSERT_EQ(again.runs.size(), 2U);
    EXPECT_EQ(again.runs[0].scene, "00000000deadbeef");
    EXPECT_EQ(again.runs[1].scene, "");
    EXPECT_EQ(again.runs[0].last_dt_s, 1.0 / 3.0);
    EXPECT_TRUE(std::isnan(again.runs[1].last_dt_s));
    ASSERT_TRUE(again.runs[1].totals.has_value());
    EXPECT_EQ(again.runs[1].totals->contact_fraction, 1.0 / 3.0);
    EXPECT_EQ(again.runs[1].totals->n_folds, 7);
    EXPECT_TRUE(std::isnan(again.runs[1].totals->probe_way_um));
    EXPECT_FALSE(kept.at("beads").runs[0].totals.has_value());
}

TEST_F(KeptReport, HasTotalsSeedBySeedWhereAnOldOneDoesNotListValues) {
    MeasuredSetups measured;
    MeasuredSetup& soft = measured["soft"];
    Totals totals{};
    for (const double Z : {9.25, 9.75}) {
        totals.coordination_Z = Z;
        soft.runs.push_back({soft.runs.size() + 1, "rest", "0.1", 300.0, 15.5, totals, ""});
    }
    write(measured);
    write("numbers.csv", "setup,number,unit,mean,standard_error,seeds,law,cells,nodes\n"
                         "soft,coordination_Z,1,9.5,0.25,2,traction,150,162\n"
                         "soft,beta,1,1.2,0.1,2,traction,150,162\n");
    const MeasuredSetups kept = kept_setups(folder);
    EXPECT_EQ(kept.at("soft").numbers[0].by_run, (std::vector<double>{9.25, 9.75}));
    EXPECT_TRUE(kept.at("soft").numbers[1].by_run.empty());
}

TEST_F(KeptReport, GetsTheNumbersThatAreMadeOfOthers) {
    MeasuredSetups measured;
    for (const char* law : {"traction", "variational"}) {
        MeasuredSetup& setup = measured[law];
        setup.law = law;
        setup.n_cells = 150;
        setup.n_nodes = 162;
        setup.numbers = {{"sigma_h_core", "kPa", {-0.015, 0.005, 2}, {-0.01, -0.02}},
                         {"R_th", "um", {40.0, 0.0, 2}, {40.0, 40.0}},
                         {"gamma_eff, rim", "mN/m", {0.3, 0.0, 2}, {0.3, 0.3}},
                         {"gamma_eff, core", "mN/m", {0.1, 0.0, 2}, {0.1, 0.1}}};
        setup.runs = {{1, "rest", "0.1", 300.0, 15.5, Totals{}, ""},
                      {2, "rest", "0.1", 300.0, 15.5, Totals{}, ""}};
    }
    write(measured);
    const MeasuredSetups kept = kept_setups(folder);
    ASSERT_EQ(kept.at("traction").numbers.size(), 5U);
    const statistics::SetupNumber& ratio = kept.at("traction").numbers.back();
    EXPECT_EQ(ratio.name, "core_over_2Gamma_R");
    ASSERT_EQ(ratio.by_run.size(), 2U);
    EXPECT_NEAR(ratio.by_run[0], 1.0, 1e-12) << "0.01 kPa of 2 x 0.2 nN/um / 40 um";
    EXPECT_NEAR(ratio.by_run[1], 2.0, 1e-12);
    EXPECT_EQ(kept.at("variational").numbers.size(), 4U) << "its films are not in gamma_eff";

    // of the means where runs are not listed: errors of 1/3, 0 and 0.01 sqrt(2) / 0.2
    MeasuredSetup& old = measured["traction"];
    for (statistics::SetupNumber& number : old.numbers) number.by_run.clear();
    for (std::size_t i : {2U, 3U}) old.numbers[i].estimate.standard_error = 0.01;
    write(measured);
    const statistics::SetupNumber of_means = kept_setups(folder).at("traction").numbers.back();
    EXPECT_EQ(of_means.name, "core_over_2Gamma_R");
    EXPECT_TRUE(of_means.by_run.empty());
    EXPECT_NEAR(of_means.estimate.mean, 1.5, 1e-12);
    EXPECT_NEAR(of_means.estimate.standard_error,
                1.5 * std::hypot(1.0 / 3.0, 0.05 * std::sqrt(2.0)), 1e-12);
    EXPECT_EQ(of_means.estimate.n, 2);
}

TEST_F(KeptReport, SaysWhatIsWrongWithAFile) {
    EXPECT_NE(refusal().find("cannot be read"), std::string::npos);
    write(MeasuredSetups{});
    EXPECT_TRUE(kept_setups(folder).empty());
    write("numbers.csv", "setup,number\na,b,c\n");
    EXPECT_NE(refusal().find("numbers.csv:2:1"), std::string::npos) << refusal();
    write("numbers.csv", "setup,number\na,b\n");
    EXPECT_NE(refusal().find("no column 'law'"), std::string::npos) << refusal();
    write("numbers.csv", "setup,number,unit,mean,standard_error,seeds,law,cells,nodes\n"
                         "a,Z,1,many,-,1,traction,3,42\n");
    EXPECT_NE(refusal().find("'mean' wants a number, got 'many'"), std::string::npos) << refusal();
    write("numbers.csv", "setup,\"number\na,b\n");
    EXPECT_NE(refusal().find("quotation has no end"), std::string::npos) << refusal();
    write("numbers.csv", "");
    EXPECT_NE(refusal().find("no columns"), std::string::npos) << refusal();
}

TEST_F(KeptReport, HasSeedsToTheirLastDigit) {
    MeasuredSetups measured;
    const std::uint64_t seed = (1ULL << 53) + 1;  // the first that no double can hold
    measured["soft"].runs = {{seed, "rest", "0.1", 300.0, 15.5, Totals{}, ""}};
    write(measured);
    EXPECT_EQ(kept_setups(folder).at("soft").runs[0].seed, seed);
}

TEST_F(KeptReport, DoesNotKnowACountThatAnOldOneDoesNotHave) {
    MeasuredSetups measured;
    Totals totals{};
    totals.n_folds = 7;
    measured["soft"].runs = {{1, "rest", "0.1", 300.0, 15.5, totals, ""}};
    write(measured);
    std::string runs = runs_report(measured).csv_text({});
    const std::string name = ",n_folds";
    ASSERT_NE(runs.find(name), std::string::npos);
    runs.replace(runs.find(name), name.size(), ",n_wrinkles");
    write("runs.csv", runs);
    const MeasuredSetups kept = kept_setups(folder);
    const TotalsRow& folds = *find_total("n_folds");
    EXPECT_TRUE(std::isnan(kept.at("soft").runs[0].total(folds)));
    // and a report of today that goes on with it does not say that there were none
    write(kept);
    EXPECT_TRUE(std::isnan(kept_setups(folder).at("soft").runs[0].total(folds)));
    write(measured);
    EXPECT_EQ(kept_setups(folder).at("soft").runs[0].total(folds), 7.0);
}

TEST_F(KeptReport, DoesNotKnowTheLastStepThatAnOldOneDoesNotHave) {
    MeasuredSetups measured;
    measured["soft"].runs = {{1, "rest", "0.1", 300.0, 15.5, Totals{}, ""}};
    measured["soft"].runs[0].last_dt_s = 1.0;
    write(measured);
    EXPECT_EQ(ends_text(kept_setups(folder).at("soft")), "rest 1 of 1, flips 0, last dt 1 s");
    std::string runs = runs_report(measured).csv_text({});
    const std::string name = ",last_dt_s";
    ASSERT_NE(runs.find(name), std::string::npos);
    runs.replace(runs.find(name), name.size(), ",first_dt_s");
    write("runs.csv", runs);
    EXPECT_EQ(ends_text(kept_setups(folder).at("soft")), "rest 1 of 1, flips 0, last dt unknown");
}

TEST_F(KeptReport, SaysWhereACountIsNone) {
    write(MeasuredSetups{});
    const std::string head = "setup,number,unit,mean,standard_error,seeds,law,cells,nodes\n";
    for (const char* cells : {"-", "inf", "nan", "1.5", "many", ""}) {
        write("numbers.csv", head + "a,Z,1,9.5,-,1,traction," + cells + ",42\n");
        EXPECT_NE(refusal().find("numbers.csv:2:24: error: 'cells' wants a whole number, got '" +
                                 std::string(cells) + "'"),
                  std::string::npos)
            << refusal();
    }
    write("numbers.csv", head + "a,Z,1,9.5,-,1,traction,99999999999,42\n");
    EXPECT_NE(refusal().find("'cells' wants a smaller whole number, got '99999999999'"),
              std::string::npos)
        << refusal();
    write("numbers.csv", head + "\"a\nb\",Z,1,9.5,-,x,traction,150,42\n");
    EXPECT_NE(refusal().find("numbers.csv:3:14: error: 'seeds' wants"), std::string::npos)
        << refusal();
}

TEST(SceneMark, IsFnv1a) {
    EXPECT_EQ(scene_mark(""), "cbf29ce484222325");
    EXPECT_EQ(scene_mark("a"), "af63dc4c8601ec8c");
}

}  // namespace
}  // namespace spheroscope::claims
