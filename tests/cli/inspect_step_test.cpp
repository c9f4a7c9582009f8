// `inspect --step` from the outside: the numbers of a step, before and after each term.
#include "tests/cli/program_runner.hpp"

#include <nlohmann/json.hpp>

#include <cmath>

namespace spheroscope {
namespace {

using nlohmann::json;

class InspectStep : public EngineRunner {
  protected:
    InspectStep() { put_run(); }
    void expect_refused(std::vector<std::string> arguments, const std::string& words) const {
        SCOPED_TRACE(words);
        arguments.insert(arguments.begin(), {"inspect", "o/run.h5", "--step"});
        const Outcome outcome = call(arguments);
        EXPECT_EQ(outcome.code, 2) << outcome.err;
        EXPECT_EQ(outcome.out, "");
        EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
    }
};

TEST_F(InspectStep, AddsUpToTheForceOnTheNode) {
    const Outcome outcome =
        call({"inspect", "o/run.h5", "--step", "--node", "1:3", "--json", "--quiet"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const json step = json_of(outcome)["step"];
    EXPECT_TRUE(step["accepted"].get<bool>());
    const json& terms = step["phases"][0]["terms"];
    ASSERT_GE(terms.size(), 4U);
    const json& last = terms.back();
    const Outcome forces = call({"inspect", "o/run.h5", "--node", "1:3", "--json", "--quiet"});
    ASSERT_EQ(forces.code, 0) << forces.err;
    const json drive = json_of(forces)["node"]["drive_nN"];
    for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(last["on_node_before_nN"][k].get<double>() +
                        last["on_node_nN"][k].get<double>(),
                    drive[k].get<double>(), 1e-9);
    const json& solve = step["phases"][1];
    EXPECT_EQ(solve["phase"], "solve");
    EXPECT_NEAR(solve["relative_residual"][0].get<double>(), 1.0, 1e-6);  // it starts from zero
    EXPECT_LT(solve["relative_residual"].back().get<double>(), 1e-2);

    const std::string text = call({"inspect", "o/run.h5", "--step", "--quiet"}).out;
    EXPECT_NE(text.find("estimated error not known"), std::string::npos)
        << "the step before is not in the file: 0 um would be no estimate";
    for (const char* words :
         {"a step of linearly_implicit", "after_nN", "|F - A v| / |F|", "the step is good: dt = "})
        EXPECT_NE(text.find(words), std::string::npos) << text;
}

TEST_F(InspectStep, OfARunUnderABeadIsOneThatTheRunWouldTake) {
    write_file("scene.toml", all_stages_scene() + "\n[[stage]]\nkind = \"indent\"\n"
                                                  "duration = \"1 s\"\nevery = \"0.5 s\"\n"
                                                  "force = \"15 nN\"\nprobe_radius = \"27 um\"\n");
    ASSERT_EQ(call({"run", "scene.toml", "-o", "b", "--quiet", "--threads", "1"}).code, 0);
    const Outcome outcome = call({"inspect", "b/run.h5", "--step", "--json", "--quiet"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const json step = json_of(outcome)["step"];
    EXPECT_TRUE(step["accepted"].get<bool>()) << outcome.out;
    EXPECT_LT(step["phases"][1]["relative_residual"].back().get<double>(), 1e-2);

    // a file of an earlier version
    const Outcome forget =
        shell("/usr/bin/python3 -c 'import h5py' 2>/dev/null || exit 77; /usr/bin/python3 -c '"
              "import h5py\n"
              "file = h5py.File(\"b/run.h5\", \"r+\")\n"
              "for step in file[\"steps\"].values(): step.pop(\"probe_motion\", None)'");
    if (forget.code == 77) GTEST_SKIP() << "no h5py";
    ASSERT_EQ(forget.code, 0) << forget.err;
    const Outcome refused = call({"inspect", "b/run.h5", "--step"});
    EXPECT_EQ(refused.code, 2);
    EXPECT_NE(refused.err.find("does not say how the bead moves"), std::string::npos)
        << refused.err;
}

TEST_F(InspectStep, SaysOfAFrameOfBeadsThatItsForcesHaveMovedNothing) {
    const Outcome outcome = call({"inspect", "o/run.h5", "--frame", "0", "--quiet"});
    EXPECT_EQ(outcome.code, 0);
    EXPECT_NE(outcome.err.find("frame 0 is of the seeding"), std::string::npos) << outcome.err;
}

TEST_F(InspectStep, RefusesWhatHasNoStep) {
    expect_refused({"--frame", "0"}, "is of the seeding");
    expect_refused({"--contact", "0-1"}, "--step is about all cells");
    expect_refused({"--node", "0:9999"}, "there is no node 0:9999");
    expect_refused({"--csv"}, "--json has them all");
}

}  // namespace
}  // namespace spheroscope
