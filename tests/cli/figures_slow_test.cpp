// The paper's figures from real small runs: 13 cells of 42 nodes, two values of gamma/omega and two
// of Et/omega, two seeds each.
#include "engine/store/hdf5_file.hpp"
#include "tests/cli/program_runner.hpp"

#include <nlohmann/json.hpp>

#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>

namespace spheroscope {
namespace {

const char* const k_scene = R"(
[scene]
title = "Thirteen cells"
[cells]
count = 13
nodes = 42
[cells.radius]
shape = 37.75
scale = "0.24 um"
min = "5 um"
max = "13 um"
[cortex.elastic]
Et_over_omega = 2
[cortex.tension]
gamma = "0.5 nN/um"
[cortex.viscosity]
eta = "1 kPa s"
[cytosol]
K = "5 kPa"
[medium]
[contact]
law = "traction"
[contact.adhesion]
gamma_over_omega = 1
[contact.friction]
normal = "0.05 kPa s/um"
tangential = "0.05 kPa s/um"
[method]
tolerance = "0.06 um"
dt_max = "0.5 s"
[[stage]]
kind = "anneal"
packing_fraction = 0.55
steps = 3000
frames = 2
[[stage]]
kind = "relax"
duration = "2 s"
[measures]
fields = ["sigma_h"]
)";

class Figures : public ProgramRunner {
  protected:
    void SetUp() override {
        if (!has_pictures()) GTEST_SKIP() << "built without pictures";
        write_file("small.toml", k_scene);
    }

    /// Runs of one setup; returns their files.
    std::vector<std::string> run(const std::string& gamma_over_omega,
                                 const std::string& Et_over_omega, const std::string& seeds) {
        const std::string folder = "g" + gamma_over_omega + "e" + Et_over_omega;
        const Outcome outcome =
            call({"run", "small.toml", "--seeds", seeds, "--threads", "1", "--quiet", "-o", folder,
                  "--set", "contact.adhesion.gamma_over_omega=" + gamma_over_omega, "--set",
                  "cortex.elastic.Et_over_omega=" + Et_over_omega});
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        std::vector<std::string> files;
        for (const std::string& name : names_in(folder))
            files.push_back(folder + "/" + name + "/run.h5");
        return files;
    }
    [[nodiscard]] std::string text_of(const std::string& name) const {
        std::ifstream file(path(name));
        return {std::istreambuf_iterator<char>(file), {}};
    }
    [[nodiscard]] nlohmann::json figures(const std::vector<std::string>& files) const {
        std::vector<std::string> arguments{"figures", "--json", "--quiet", "-o", "figures"};
        arguments.insert(arguments.end(), files.begin(), files.end());
        const Outcome outcome = call(arguments);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return json_of(outcome);
    }
};

void append(std::vector<std::string>& all, const std::vector<std::string>& more) {
    all.insert(all.end(), more.begin(), more.end());
}

TEST_F(Figures, OfAGridOfRunsAreAllDrawnWithTheirNumbers) {
    std::vector<std::string> files;
    append(files, run("1", "2", "1..2"));
    append(files, run("1", "8", "1..2"));
    append(files, run("4", "2", "1..2"));
    append(files, run("4", "8", "1"));
    const nlohmann::json document = figures(files);
    ASSERT_EQ(document["figures"].size(), 6U);
    for (const auto& figure : document["figures"]) {
        const std::string name = figure["name"].get<std::string>();
        if (name == "force_displacement") {
            EXPECT_EQ(figure["files"].size(), 0U) << "no bead presses";
            EXPECT_EQ(figure["missing"].size(), 7U) << "and each run says so";
            continue;
        }
        for (const char* ending : {".png", ".svg", ".csv"})
            EXPECT_TRUE(std::filesystem::exists(path("figures/" + name + ending)))
                << name << ending;
        const std::string svg = text_of("figures/" + name + ".svg");
        EXPECT_NE(svg.find("Made by: "), std::string::npos) << name;
    }
    EXPECT_EQ(document["setups"].size(), 4U);
    EXPECT_EQ(document["left_out"].size(), 0U);
    EXPECT_NE(document.dump().find("1 seed, others have 2"), std::string::npos);
    const std::string map = text_of("figures/fig7.csv");
    EXPECT_NE(map.find("broad grid: 4 of 30 points have runs"), std::string::npos) << map;

    // The mean over seeds in the CSV is the one that info prints.
    const auto info = json_of(call({"info", files[0], files[1], "--json"}));
    const auto& Z = info["setups"][0]["totals"]["coordination_Z"];
    const auto& ours = document["setups"][0]["numbers"]["coordination_Z"];
    EXPECT_EQ(ours["mean"], Z["mean"]);
    EXPECT_EQ(ours["standard_error"], Z["standard_error"]);
}

TEST_F(Figures, CountFramesUnderTheBeadWithoutAForce) {
    write_file("loaded.toml",
               with(k_scene, "[measures]",
                    "[[stage]]\nkind = \"indent\"\nduration = \"1 s\"\nevery = \"0.25 s\"\n"
                    "force = \"15 nN\"\nprobe_radius = \"27 um\"\n[measures]") +
                   "[[picture]]\nfield = \"sigma_h\"\n");
    const Outcome run = call({"run", "loaded.toml", "--threads", "1", "--quiet", "-o", "o"});
    ASSERT_EQ(run.code, 0) << run.err;
    {
        hdf5::File file(path("o/run.h5"), hdf5::File::Mode::append);
        const std::string force = "/diagnostics/probe_force";
        const std::uint64_t n_frames = file.shape(force).at(0);
        file.truncate_column(force, n_frames - 1);
        file.append_to_column(force, std::numeric_limits<double>::quiet_NaN());
        file.commit();
    }
    const nlohmann::json document = figures({"o/run.h5"});
    EXPECT_NE(document["remarks"].dump().find("seed 1: no points of 1 frame under the bead"),
              std::string::npos)
        << document["remarks"];
    EXPECT_NE(text_of("figures/force_displacement.csv").find("no points of 1 frame"),
              std::string::npos);
}

TEST_F(Figures, ShowTheStagesOfARunBesideEachOtherWhereTheyAreAskedTo) {
    write_file("pictured.toml", std::string(k_scene) + "[[picture]]\nfield = \"sigma_h\"\n");
    ASSERT_EQ(call({"run", "pictured.toml", "--threads", "1", "--quiet", "-o", "o"}).code, 0);
    const Outcome drawn = call({"figures", "o/run.h5", "--only", "fig1", "-o", "figures"});
    ASSERT_EQ(drawn.code, 0) << drawn.err;
    EXPECT_EQ(names_in("figures"), (std::vector<std::string>{"fig1.png", "numbers.csv"}));
    const std::string file = text_of("figures/fig1.png");
    for (const char* words :
         {"Fig. 1: the way of one run", "Thirteen cells (pictured.toml, seed 1): frames ",
          "one range in all pictures, that of those without a wall",
          " figures o/run.h5 --only fig1 -o figures", "\"heading\":\"b  relaxation\""})
        EXPECT_NE(file.find(words), std::string::npos) << words;
    const Outcome again = call({"movie", "--verify", "figures/fig1.png", "o/run.h5"});
    EXPECT_EQ(again.code, 0) << again.out << again.err;
    // a scene without pictures does not say which field
    EXPECT_EQ(call({"figures", run("1", "2", "1").front(), "--only", "fig1"}).code, 2);
}

TEST_F(Figures, NameARunThatCannotServeAndAFigureThatCannotBeDrawn) {
    const std::vector<std::string> files = run("1", "2", "1");
    write_file("beads.toml",
               with(k_scene, "[[stage]]\nkind = \"relax\"\nduration = \"2 s\"\n", ""));
    EXPECT_EQ(call({"run", "beads.toml", "-o", "beads", "--quiet"}).code, 0);
    const nlohmann::json document = figures({files[0], "beads/run.h5"});
    ASSERT_EQ(document["left_out"].size(), 1U);
    EXPECT_EQ(document["left_out"][0]["file"], "beads/run.h5");
    EXPECT_NE(document["left_out"][0]["reason"].get<std::string>().find("beads"),
              std::string::npos);
    const auto& map = document["figures"][5];
    EXPECT_EQ(map["name"], "fig7");
    EXPECT_EQ(map["files"].size(), 0U);
    EXPECT_NE(map["missing"][0].get<std::string>().find("a map wants two of each"),
              std::string::npos);
    EXPECT_FALSE(std::filesystem::exists(path("figures/fig7.png")));

    EXPECT_EQ(call({"figures", "beads/run.h5"}).code, 2);
    EXPECT_EQ(call({"figures"}).code, 2);
    EXPECT_EQ(call({"figures", "nowhere.h5"}).code, 2);
    EXPECT_EQ(call({"figures", files[0], files[0]}).code, 2) << "the same seed twice";
    const Outcome wrong = call({"figures", files[0], "--only", "fig9"});
    EXPECT_EQ(wrong.code, 2);
    EXPECT_NE(wrong.err.find("fig2, fig3"), std::string::npos) << wrong.err;
}

}  // namespace
}  // namespace spheroscope
