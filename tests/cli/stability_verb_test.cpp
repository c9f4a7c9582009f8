// `stability` and `bench`, as a script sees them.
#include "tests/cli/program_runner.hpp"
#include "tests/reports/stretched_cell.hpp"

#include <nlohmann/json.hpp>

#include <chrono>
#include <csignal>
#include <fstream>
#include <thread>

namespace spheroscope {
namespace {

/// What every method brings to its end.
const std::string k_scene = stretched_cell_text("0.032 s", "dt = \"4 ms\"\n") + R"([expect]
volume_error = { max = 0.1 }
[stability.all]
outcome = "ends"
[[variant]]
name = "soft"
set = ["cortex.elastic.E=20"]
[[variant]]
name = "refused"
set = ["cortex.elastic.E=-1", "stability.all.outcome=stops", "stability.all.names=['E']"]
)";

class StabilityVerb : public EngineRunner {
  protected:
    StabilityVerb() { write_file("scene.toml", k_scene); }
    /// The comment of a report that says where it was made.
    [[nodiscard]] std::string machine_of(const std::string& csv) const {
        std::ifstream file(path(csv));
        for (std::string line; std::getline(file, line);)
            if (line.starts_with("# machine: ")) return line;
        return "";
    }
    [[nodiscard]] Outcome judge(const std::string& scene) const {
        write_file("scene.toml", scene);
        return call({"stability", "scene.toml", "--json", "--quiet"});
    }
};

TEST_F(StabilityVerb, GivesOneObjectForEachSceneAndMethodWithWhatScriptsRelyOn) {
    const Outcome outcome = judge(k_scene);
    EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
    const auto document = json_of(outcome);
    ASSERT_GE(document["runs"].size(), 4U);
    int n_refused = 0;
    for (const auto& run : document["runs"]) {
        for (const char* key : {"scene", "method", "expectation", "outcome", "met", "hash"})
            EXPECT_TRUE(run.contains(key)) << key;
        EXPECT_EQ(run["met"], true) << run;
        if (run["outcome"] == "refused") ++n_refused;
    }
    EXPECT_EQ(2 * n_refused, static_cast<int>(document["runs"].size()));
}

TEST_F(StabilityVerb, SaysHowManyThreadsWereUsed) {
    const Outcome outcome =
        call({"stability", "scene.toml", "--json", "--quiet", "-o", "here", "--threads", "1"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_TRUE(machine_of("here/stability.csv").ends_with(", 1 thread used"))
        << machine_of("here/stability.csv");
    EXPECT_EQ(json_of(outcome)["machine"]["threads"], 1);
}

TEST_F(StabilityVerb, EndsWithFourWhenAMeasureIsNotAsExpected) {
    const Outcome outcome = judge(with(k_scene, "{ max = 0.1 }", "{ max = 1e-12 }"));
    EXPECT_EQ(outcome.code, 4);
    const auto document = json_of(outcome);
    for (const auto& run : document["runs"])
        if (run["outcome"] == "ended") {
            EXPECT_EQ(run["met"], false);
            EXPECT_NE(run["failures"][0].get<std::string>().find("volume_error"),
                      std::string::npos);
        }
}

TEST_F(StabilityVerb, EndsWithFourWhenARunThatShouldStopComesToItsEnd) {
    EXPECT_EQ(judge(with(k_scene, "outcome = \"ends\"", "outcome = \"stops\"")).code, 4);
}

TEST_F(StabilityVerb, EndsWithFourWhenTheReasonNamesSomethingElse) {
    EXPECT_EQ(judge(with(k_scene, "['E']", "['viscosity']")).code, 4);
    EXPECT_EQ(judge(with(k_scene, "['E']", "['elasti']")).code, 4) << "a part of a word";
    EXPECT_EQ(judge(with(k_scene, "['E']", "['elastic']")).code, 0);
}

TEST_F(StabilityVerb, AStopThatWasExpectedIsMetAndALaterOneThanAllowedIsNot) {
    std::string scene = with(k_scene, "20 kPa", "2000 kPa");
    scene = with(scene, "cortex.elastic.E=20\"", "cortex.elastic.E=2000\"");
    scene = with(scene, "dt = \"4 ms\"", "dt = \"30 ms\"");
    scene = with(scene, "[stability.all]",
                 "[stability.forward_euler]\noutcome = \"stops\"\nwithin = 1\n[stability.all]");
    const Outcome outcome = judge(scene);
    const auto document = json_of(outcome);
    for (const auto& run : document["runs"])
        if (run["method"] == "forward_euler" && run["variant"] == "soft") {
            EXPECT_EQ(run["outcome"], "stopped") << run;
            EXPECT_EQ(run["met"], true) << run;
        }
}

TEST_F(StabilityVerb, ASceneThatExpectsNothingIsAMistake) {
    const Outcome outcome = judge(k_scene.substr(0, k_scene.find("[stability.all]")));
    EXPECT_EQ(outcome.code, 2);
    EXPECT_NE(outcome.err.find("does not say what it expects"), std::string::npos) << outcome.err;
}

TEST_F(StabilityVerb, AClassOfMethodsThatDoesNotExistIsAMistake) {
    const Outcome outcome = judge(with(
        k_scene, "[stability.all]", "[stability.implicid]\noutcome = \"ends\"\n[stability.all]"));
    EXPECT_EQ(outcome.code, 2);
    EXPECT_NE(outcome.err.find("implicid"), std::string::npos) << outcome.err;
}

TEST_F(StabilityVerb, StepsFindsTheBlowUpOfTheExplicitMethodBesideTheEstimate) {
    const Outcome outcome =
        call({"stability", "scene.toml", "--steps", "--json", "--quiet", "--set",
              "cortex.elastic.E=320", "--set", "stage[0].duration=0.256 s"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const auto ladder = json_of(outcome)["ladders"][0];
    EXPECT_EQ(ladder["method"], "forward_euler");
    const double stable = ladder["largest_stable_s"], unstable = ladder["smallest_unstable_s"];
    EXPECT_LT(stable, unstable);
    EXPECT_LT(unstable, 1.1 * stable) << "bisected";
    const double ratio = ladder["estimate_over_stable"];
    EXPECT_GE(ratio, 0.7);
    EXPECT_LE(ratio, 1.0);
    EXPECT_EQ(ladder["met"], true);
}

TEST_F(StabilityVerb, StepsEndsWithFourWhereNoStepHoldsThatTheEstimateCouldBeComparedWith) {
    const Outcome outcome = call({"stability", "scene.toml", "--steps", "--json", "--quiet",
                                  "--set", "start.sliver_height=1e-9 um"});
    EXPECT_EQ(outcome.code, 4) << outcome.out << outcome.err;
    const auto ladder = json_of(outcome)["ladders"][0];
    EXPECT_EQ(ladder["met"], false);
    EXPECT_TRUE(ladder["estimate_over_stable"].is_null());
}

/// Whether the process has a handler of SIGINT by now (proc(5), SigCgt).
bool catches_sigint(pid_t process) {
    std::ifstream status("/proc/" + std::to_string(process) + "/status");
    for (std::string line; std::getline(status, line);)
        if (line.starts_with("SigCgt:"))
            return (std::stoull(line.substr(7), nullptr, 16) >> (SIGINT - 1) & 1U) != 0;
    return false;
}

TEST_F(StabilityVerb, StepsThatAreInterruptedAreNotTakenForABlowUp) {
    const pid_t process = start({"stability", "scene.toml", "--steps", "--quiet", "-o", "here",
                                 "--set", "stage[0].duration=32768 s"});
    for (int i = 0; i < 2000 && !catches_sigint(process); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    kill(process, SIGINT);
    const Outcome outcome = wait_for(process);
    EXPECT_EQ(outcome.code, 130) << outcome.err;
    EXPECT_EQ(outcome.out.find("NOT MET"), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find("\ninterrupted  "), std::string::npos) << outcome.out;
    std::ifstream file(path("here/steps.csv"));
    std::string last;
    for (std::string line; std::getline(file, line);) last = line;
    EXPECT_TRUE(last.starts_with("scene,method,")) << last;
}

TEST_F(StabilityVerb, StepsHaveNoTimeLimit) {
    const Outcome outcome =
        call({"stability", "scene.toml", "--steps", "--time-limit", "1 s", "--quiet"});
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.err,
              "error: --steps and --time-limit exclude each other\n"
              "  hint: a step that is not run to its end is neither held nor blown up\n");
}

TEST_F(StabilityVerb, StepsFindsNodesThatBounce) {
    const Outcome outcome =
        call({"stability", SPHEROSCOPE_SOURCE_DIR "/scenes/bench/doublet_stiff.toml", "--steps",
              "--json", "--quiet", "--threads", "1", "--set", "cells.nodes=42"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const auto document = json_of(outcome);
    const auto& ladder = document["ladders"][0];
    EXPECT_EQ(ladder["met"], true) << ladder["estimate_over_stable"];
    int n_bouncing = 0;
    for (const auto& trial : ladder["trials"]) {
        if (trial["stable"].get<bool>()) {
            EXPECT_LT(trial["speed_ratio"].get<double>(), 2.0) << trial;
        } else if (trial["why"].get<std::string>().find("times too fast") != std::string::npos) {
            EXPECT_GT(trial["speed_ratio"].get<double>(), 2.0) << trial;
            ++n_bouncing;
        }
    }
    EXPECT_GT(n_bouncing, 0);
}

TEST_F(StabilityVerb, BenchGivesTimesTogetherWithErrorsAndHashes) {
    const Outcome outcome = call({"bench", "--quick", "--repetitions", "1", "--json", "--quiet",
                                  "-o", "here", "--time-limit", "50 ms"});
    const auto document = json_of(outcome);
    EXPECT_EQ(outcome.code, document["complete"] == true ? 0 : 3) << outcome.err;
    ASSERT_GE(document["rows"].size(), 1U);
    const auto& row = document["rows"][0];
    for (const char* key : {"cells", "nodes", "threads", "force", "force_error", "terms", "solve",
                            "solve_iterations", "solve_residual", "steps", "memory_MB"})
        EXPECT_TRUE(row.contains(key)) << key;
    EXPECT_GT(row["force"]["cpu_ms"], 0.0);
    EXPECT_LE(row["solve_residual"], 2e-3);
    for (const auto& step : row["steps"])
        for (const char* key : {"method", "time", "step_error_um", "hash"})
            EXPECT_TRUE(step.contains(key)) << key;
    EXPECT_EQ(names_in("here"), (std::vector<std::string>{"bench.csv", "bench.json"}));
    EXPECT_EQ(machine_of("here/bench.csv").find("used"), std::string::npos)
        << "each row has its own threads: " << machine_of("here/bench.csv");
    EXPECT_FALSE(document["machine"].contains("threads"));
}

TEST_F(StabilityVerb, BenchTimesTheKernelThatWasAskedForAndNamesIt) {
    const Outcome outcome = call({"bench", "--cells", "13", "--nodes", "162", "--repetitions", "1",
                                  "--simd", "scalar", "--precision", "double", "--json", "--quiet",
                                  "-o", "kernel", "--time-limit", "1 ms"});
    const auto document = json_of(outcome);
    EXPECT_EQ(document["simd"], "scalar");
    EXPECT_EQ(document["precision"], "double");
    for (const auto& row : document["rows"]) {
        EXPECT_EQ(row["simd"], "scalar");
        EXPECT_LT(row["force_error"], 1e-12);
    }
    const Outcome mistaken = call({"bench", "--precision", "half", "--quiet"});
    EXPECT_EQ(mistaken.code, 2);
    EXPECT_NE(mistaken.err.find("float or double"), std::string::npos) << mistaken.err;
}

TEST_F(StabilityVerb, BenchTakesTheSizesThatWereAskedForAndNamesThemWhenThereAreNone) {
    const Outcome outcome = call({"bench", "--cells", "1", "--nodes", "162", "--repetitions", "1",
                                  "--json", "--quiet", "-o", "one"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const auto rows = json_of(outcome)["rows"];
    ASSERT_EQ(rows.size(), 2U);  // on one thread and on two
    for (const auto& row : rows) EXPECT_EQ(row["cells"], 1);
    const Outcome none = call({"bench", "--cells", "7", "--quiet", "-o", "none"});
    EXPECT_EQ(none.code, 2);
    EXPECT_NE(none.err.find("150 x 642"), std::string::npos) << none.err;
}

}  // namespace
}  // namespace spheroscope
