// reproduce: runs that are missing are made, claims judged, failures listed.
#include "tests/cli/program_runner.hpp"
#include "tests/cli/three_cells_scene.hpp"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <sstream>

namespace spheroscope {
namespace {

const std::string k_claims = R"(
[[setup]]
name = "soft"
scene = "small.toml"
set = ["cortex.elastic.E=1 kPa"]
seeds = [1, 2]
quick_seeds = [1]
[[setup]]
name = "stiff"
scene = "small.toml"
seeds = [1]
[[claim]]
id = "three_cells_have_a_rim"
source = "of its own"
says = "all cells of so few are at the rim"
setup = ["soft", "stiff"]
number = "rim_share"
is = 1
[[claim]]
id = "they_are_a_core"
source = "of its own"
says = "there is none"
setup = "soft"
number = "rim_share"
below = 0.5
)";

class Reproduce : public EngineRunner {
  protected:
    Reproduce() {
        write_file("small.toml", k_three_cells_scene);
        write_file("small.claims", k_claims);
    }
    Outcome reproduce(const std::string& extent) {
        return call({"reproduce", "small.claims", extent, "-o", "out", "--threads", "1", "--quiet",
                     "--json"});
    }
    static std::string verdict(const Outcome& outcome, std::size_t row) {
        return json_of(outcome)["claims"][row]["verdict"];
    }
};

TEST_F(Reproduce, JamsBeadsOnceAndKeepsWhatCameOut) {
    write_file("small.claims", R"(
[[setup]]
name = "beads"
beads = 150
seeds = [1, 2]
quick_seeds = [1]
[[claim]]
id = "they_jam"
source = "of its own"
says = "somewhere near random close packing"
setup = "beads"
number = "jamming_fraction"
between = [0.60, 0.66]
)");
    const Outcome quick = reproduce("--quick");
    ASSERT_EQ(quick.code, 0) << quick.err;
    EXPECT_EQ(verdict(quick, 0), "agrees");
    const std::filesystem::path kept = path("out/beads/seed=1/jamming.json");
    const auto made = std::filesystem::last_write_time(kept);
    const Outcome full = reproduce("--full");
    EXPECT_EQ(json_of(full)["claims"][0]["seeds"], 2);
    EXPECT_EQ(std::filesystem::last_write_time(kept), made);
    EXPECT_EQ(reproduce("--stored").code, 0);

    std::ofstream(kept) << "{\"beads\": 150}";  // half a file
    const Outcome damaged = reproduce("--stored");
    EXPECT_EQ(damaged.code, 3);
    EXPECT_NE(damaged.err.find("jamming.json"), std::string::npos) << damaged.err;
    EXPECT_EQ(json_of(damaged)["claims"][0]["seeds"], 1);
}

TEST_F(Reproduce, MakesTheRunsThatAreMissingAndJudges) {
    const Outcome quick = reproduce("--quick");
    ASSERT_EQ(quick.code, 0) << quick.err;
    EXPECT_EQ(verdict(quick, 0), "agrees");
    EXPECT_EQ(verdict(quick, 1), "no data");  // no quick seeds
    EXPECT_EQ(verdict(quick, 2), "differs");
    const nlohmann::json row = json_of(quick)["claims"][0];
    EXPECT_EQ(row["claim"], "three_cells_have_a_rim/soft");
    EXPECT_EQ(row["paper"], "1");
    EXPECT_EQ(row["mean"], 1.0);
    EXPECT_TRUE(row["standard_error"].is_null()) << "one seed";
    EXPECT_EQ(row["written"], "before");
    EXPECT_EQ(row["ends"].get<std::string>().find("rest 0 of 1, flips 0, last dt 0.0"), 0U)
        << row["ends"];
    EXPECT_NE(json_of(quick)["remarks"].dump().find("soft, seed 1 (done): nodes still move with "),
              std::string::npos)
        << quick.out;
    EXPECT_EQ(row["command"], "spheroscope reproduce small.claims --full --only soft");
    EXPECT_TRUE(std::filesystem::exists(path("out/soft/seed=1/run.h5")));
    EXPECT_FALSE(std::filesystem::exists(path("out/soft/seed=2/run.h5")));
    const auto made = std::filesystem::last_write_time(path("out/soft/seed=1/run.h5"));

    const Outcome full = reproduce("--full");
    ASSERT_EQ(full.code, 0) << full.err;
    EXPECT_EQ(verdict(full, 1), "agrees");
    EXPECT_EQ(json_of(full)["claims"][0]["seeds"], 2);
    EXPECT_EQ(std::filesystem::last_write_time(path("out/soft/seed=1/run.h5")), made);

    std::filesystem::remove(path("out/stiff/seed=1/run.h5"));
    const Outcome stored = reproduce("--stored");
    ASSERT_EQ(stored.code, 0) << stored.err;
    EXPECT_EQ(verdict(stored, 0), "agrees");
    EXPECT_EQ(verdict(stored, 1), "no data");
    for (const char* file : {"out/claims.csv", "out/claims.md", "out/numbers.csv", "out/runs.csv"})
        EXPECT_GT(std::filesystem::file_size(path(file)), 100U) << file;
}

TEST_F(Reproduce, GoesOnWithTheNumbersOfAnEarlierReport) {
    const Outcome full = reproduce("--full");
    ASSERT_EQ(full.code, 0);
    std::filesystem::create_directories(path("report"));
    for (const char* name : {"numbers.csv", "runs.csv"})
        std::filesystem::copy_file(path("out/" + std::string(name)),
                                   path("report/" + std::string(name)));
    std::filesystem::remove_all(path("out/soft"));
    const auto again = [&] {
        return call({"reproduce", "small.claims", "--stored", "-o", "out", "--keep", "report",
                     "--quiet", "--json"});
    };
    const Outcome kept = again();
    ASSERT_EQ(kept.code, 0) << kept.err;
    EXPECT_EQ(verdict(kept, 0), "agrees");
    EXPECT_EQ(json_of(kept)["claims"][0]["seeds"], 2);
    EXPECT_EQ(verdict(kept, 2), "differs");
    const auto text_of = [&](const std::string& name) {
        std::ifstream file(path(name));
        std::string text, line;
        while (std::getline(file, line))
            if (!line.starts_with("#")) text += line + "\n";
        return text;
    };
    EXPECT_EQ(text_of("out/numbers.csv"), text_of("report/numbers.csv"));
    const std::string marked = text_of("report/runs.csv");
    EXPECT_EQ(text_of("out/runs.csv"), marked);

    // said once of kept runs too, and the end of each of them is known
    const auto rows = json_of(kept);
    EXPECT_EQ(rows["claims"][0]["ends"], json_of(full)["claims"][0]["ends"]);
    const std::string said = rows["remarks"].dump();
    const std::size_t at = said.find("soft, seed 1 (done), 2 (done): nodes still move with ");
    ASSERT_NE(at, std::string::npos) << said;
    EXPECT_EQ(said.find("soft, seed 1 (done)", at + 1), std::string::npos) << said;

    // an older report does not mark the scenes of its runs; kept twice, it says so once
    std::string unmarked = marked;
    const std::size_t column = unmarked.find("scene");
    ASSERT_NE(column, std::string::npos);
    unmarked.replace(column, 5, "other");
    write_file("report/runs.csv", unmarked);
    ASSERT_EQ(again().code, 0);
    std::filesystem::rename(path("out/runs.csv"), path("report/runs.csv"));
    const Outcome twice = again();
    ASSERT_EQ(twice.code, 0) << twice.err;
    const auto document = json_of(twice);
    int n_remarks = 0;
    for (const auto& remark : document["remarks"])
        if (remark.get<std::string>().find("does not say of which version") != std::string::npos)
            ++n_remarks;
    EXPECT_EQ(n_remarks, 1) << twice.out;
    write_file("report/runs.csv", marked);

    // a number of another version of the scene is not that of this one
    std::string scene(k_three_cells_scene);
    scene.replace(scene.find("Three cells"), 11, "Three others");
    write_file("small.toml", scene);
    std::filesystem::remove_all(path("out/stiff"));
    const Outcome changed = again();
    EXPECT_EQ(changed.code, 2);
    EXPECT_NE(changed.err.find("was measured on another version of small.toml"), std::string::npos)
        << changed.err;
}

TEST_F(Reproduce, ListsARunThatFailsWithItsReason) {
    write_file("small.claims", k_claims + "\n[[setup]]\nname = \"wild\"\nscene = \"small.toml\"\n"
                                          "set = [\"method.name=forward_euler\", "
                                          "\"method.dt=50 ms\", \"cortex.elastic.E=2000 kPa\"]\n"
                                          "seeds = [1]\nquick_seeds = [1]\n");
    const Outcome outcome = reproduce("--quick");
    EXPECT_EQ(outcome.code, 3);
    EXPECT_NE(outcome.out.find("wild, seed 1"), std::string::npos) << outcome.out;
    EXPECT_EQ(verdict(outcome, 0), "agrees");
}

TEST_F(Reproduce, ListsARunThatMissesWhatItsSceneExpects) {
    write_file("small.toml", std::string(k_three_cells_scene) +
                                 "\n[expect]\ncontact_fraction = { min = 0.9 }\n"
                                 "n_flipped_triangles = { max = 0 }\n");
    const Outcome outcome = reproduce("--quick");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    std::string remarks;
    const auto document = json_of(outcome);
    for (const auto& remark : document["remarks"]) remarks += remark.get<std::string>() + "\n";
    EXPECT_NE(remarks.find("seed 1 misses [expect] of its scene: contact_fraction is 0."),
              std::string::npos)
        << remarks;
    EXPECT_EQ(remarks.find("n_flipped_triangles"), std::string::npos) << remarks;
}

TEST_F(Reproduce, GoesOnWhereAFolderCannotBeMade) {
    write_file("small.claims", with(k_claims, "[[setup]]\nname = \"stiff\"",
                                    "[[setup]]\nname = \"beads\"\nbeads = 150\nseeds = [1]\n"
                                    "[[setup]]\nname = \"stiff\""));
    std::filesystem::create_directories(path("out"));
    write_file("out/beads", "no folder");
    const Outcome outcome = reproduce("--full");
    EXPECT_EQ(outcome.code, 3) << outcome.err;
    EXPECT_NE(outcome.err.find("out/beads/seed=1: cannot make this folder"), std::string::npos)
        << outcome.err;
    EXPECT_EQ(verdict(outcome, 0), "agrees") << "of the other setups: " << outcome.out;
}

TEST_F(Reproduce, KeepsARunOfTheSameSceneWithOtherPictures) {
    ASSERT_EQ(reproduce("--quick").code, 0);
    write_file("small.toml",
               k_three_cells_scene + std::string("[[picture]]\nfield = \"sigma_h\"\n"));
    const Outcome outcome = reproduce("--stored");
    EXPECT_EQ(outcome.err, "");
    EXPECT_EQ(json_of(outcome)["claims"][0]["seeds"], 1) << outcome.out;
}

TEST_F(Reproduce, RefusesARunOfAnotherScene) {
    ASSERT_EQ(reproduce("--quick").code, 0);
    std::string changed = k_claims;
    changed.replace(changed.find("E=1 kPa"), 7, "E=2 kPa");
    write_file("small.claims", changed);
    const Outcome outcome = reproduce("--quick");
    EXPECT_EQ(outcome.code, 3);
    EXPECT_NE(outcome.out.find("another scene"), std::string::npos) << outcome.out;
    EXPECT_EQ(verdict(outcome, 0), "no data");
}

TEST_F(Reproduce, DoesNotMakeTheFolderOfStoredRuns) {
    const Outcome outcome = reproduce("--stored");
    EXPECT_EQ(outcome.code, 2);
    EXPECT_NE(outcome.err.find("--stored wants a folder with runs"), std::string::npos)
        << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(path("out")));
}

TEST_F(Reproduce, WantsToKnowHowMuch) {
    EXPECT_EQ(call({"reproduce", "small.claims"}).code, 2);
    EXPECT_EQ(call({"reproduce", "small.claims", "--quick", "--full"}).code, 2);
    const Outcome outcome = call({"reproduce", "small.claims", "--quick", "--only", "none"});
    EXPECT_EQ(outcome.code, 2);
    EXPECT_NE(outcome.err.find("setups are soft, stiff"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace spheroscope
