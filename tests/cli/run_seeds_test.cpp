// run --seeds, and what info says of several runs.
#include "engine/cli/seed_means_text.hpp"
#include "tests/cli/program_runner.hpp"
#include "tests/cli/three_cells_scene.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <map>
#include <string>

namespace spheroscope {
namespace {

class RunSeeds : public EngineRunner {
  protected:
    RunSeeds() { write_file("small.toml", k_three_cells_scene); }
};

TEST_F(RunSeeds, MakesOneRunForEachSeedAndTheirMeans) {
    const Outcome outcome = call({"run", "small.toml", "--seeds", "1..3", "-o", "out", "--threads",
                                  "1", "--quiet", "--json"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const auto document = json_of(outcome);
    ASSERT_EQ(document["seeds"].size(), 3U);
    double sum = 0.0, square = 0.0;
    for (int seed = 1; seed <= 3; ++seed) {
        const std::string file = "out/seed_" + std::to_string(seed) + "/run.h5";
        const auto info = json_of(call({"info", file, "--json"}));
        EXPECT_EQ(info["seed"], seed);
        const double area = info["totals"]["contact_area"].get<double>();
        sum += area;
        square += area * area;
    }
    const auto& area = document["totals"]["contact_area"];
    EXPECT_NEAR(area["mean"].get<double>(), sum / 3.0, 1e-9 * sum);
    EXPECT_NEAR(area["standard_error"].get<double>(),
                std::sqrt((square - sum * sum / 3.0) / 2.0 / 3.0), 1e-6 * sum);
    // and info of the three files says the same
    const auto info = json_of(
        call({"info", "out/seed_1/run.h5", "out/seed_2/run.h5", "out/seed_3/run.h5", "--json"}));
    ASSERT_EQ(info["setups"].size(), 1U);
    for (const char* measure : {"contact_area", "coordination_Z", "sigma_h_size"})
        EXPECT_EQ(info["setups"][0]["totals"][measure], document["totals"][measure]) << measure;
    const Outcome text =
        call({"info", "out/seed_1/run.h5", "out/seed_2/run.h5", "out/seed_3/run.h5"});
    EXPECT_NE(text.out.find("+-"), std::string::npos) << text.out;
    // 0.3 s after beads have become cells nothing is at rest
    const std::string moving = "seed 1 (done), 2 (done), 3 (done): nodes still move with ";
    EXPECT_NE(text.out.find(moving), std::string::npos) << text.out;
    const auto& remarks = info["setups"][0]["remarks"];
    ASSERT_FALSE(remarks.empty());
    EXPECT_EQ(remarks[0].get<std::string>().find(moving), 0U);
    // what is not resolved in a run is said beside the means, and nothing else is
    std::map<std::string, std::string> seeds_of;
    for (int seed = 1; seed <= 3; ++seed) {
        const std::string file = "out/seed_" + std::to_string(seed) + "/run.h5";
        const auto of_one = json_of(call({"info", file, "--json"}));
        for (const auto& measure : of_one["not_resolved"])
            seeds_of[measure] += (seeds_of[measure].empty() ? "" : ", ") + std::to_string(seed);
    }
    EXPECT_EQ(remarks.size(), 1 + seeds_of.size());
    for (const auto& [measure, seeds] : seeds_of) {
        const std::string remark = measure + " is not resolved in seed " + seeds + ": ";
        EXPECT_NE(text.out.find(remark), std::string::npos) << remark << text.out;
    }
}

TEST(SeedMeans, SayWhichMeasureIsNotResolvedInWhichSeed) {
    MeasureError good{"sigma_h_core", "kPa", 1.0}, bad = good;
    good.time = 0.5;
    bad.time = 1.5;
    const std::vector<std::uint64_t> seeds{4, 5, 6};
    const std::vector<std::string> remarks = cli::remarks_on_resolution(
        seeds, std::vector<std::vector<MeasureError>>{{bad}, {good}, {bad}});
    // the defect from Young-Laplace is made of the core's stress
    ASSERT_EQ(remarks.size(), 3U);
    EXPECT_EQ(remarks[0],
              "sigma_h_core is not resolved in seed 4, 6: its error there is larger than "
              "its value");
    EXPECT_EQ(remarks[1].find("eps_YL_omega is not resolved in seed 4, 6"), 0U);
    EXPECT_TRUE(
        cli::remarks_on_resolution(seeds, std::vector<std::vector<MeasureError>>(3)).empty());
}

TEST_F(RunSeeds, GoOnAfterASeedThatFailedAndEndWithItsCode) {
    // Seed 2 cannot begin: its folder is a file.
    std::filesystem::create_directories(path("out"));
    write_file("out/seed_2", "in the way");
    const Outcome outcome = call({"run", "small.toml", "--seeds", "1..3", "-o", "out", "--threads",
                                  "1", "--quiet", "--json"});
    EXPECT_EQ(outcome.code, 2);
    EXPECT_NE(outcome.err.find("seed 2 failed"), std::string::npos) << outcome.err;
    const auto document = json_of(outcome);
    ASSERT_EQ(document["seeds"].size(), 3U);
    EXPECT_EQ(document["seeds"][1]["outcome"], "failed");
    EXPECT_NE(document["seeds"][1]["reason"], "");
    EXPECT_EQ(document["totals"]["contact_area"]["seeds"], 2);
    // What is missing is made when the cause is gone; what is there stays.
    std::filesystem::remove(path("out/seed_2"));
    const auto before = std::filesystem::last_write_time(path("out/seed_1/run.h5"));
    const Outcome again = call({"run", "small.toml", "--seeds", "1..3", "-o", "out", "--threads",
                                "1", "--quiet", "--json", "--resume"});
    EXPECT_EQ(again.code, 0) << again.err;
    EXPECT_EQ(json_of(again)["totals"]["contact_area"]["seeds"], 3);
    EXPECT_EQ(std::filesystem::last_write_time(path("out/seed_1/run.h5")), before);
}

TEST_F(RunSeeds, AndSeedExcludeEachOther) {
    const Outcome outcome = call({"run", "small.toml", "--seeds", "1..3", "--seed", "4"});
    EXPECT_EQ(outcome.code, 2);
    EXPECT_NE(outcome.err.find("--seeds"), std::string::npos) << outcome.err;
    EXPECT_EQ(call({"run", "small.toml", "--seeds", "3..1"}).code, 2);
}

TEST_F(RunSeeds, OfAWrongSceneIsOneMistake) {
    write_file("wrong.toml", with(k_three_cells_scene, "count = 3", "count = -3"));
    const Outcome outcome = call({"run", "wrong.toml", "--seeds", "1..3"});
    EXPECT_EQ(outcome.code, 2);
    EXPECT_NE(outcome.err.find("wrong.toml:"), std::string::npos) << outcome.err;
}

TEST_F(RunSeeds, InfoWantsAFile) {
    const Outcome outcome = call({"info"});
    EXPECT_EQ(outcome.code, 2);
    EXPECT_NE(outcome.err.find("FILE"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace spheroscope
