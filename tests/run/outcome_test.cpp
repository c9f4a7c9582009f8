// What a run says of its end: what is true there, whatever was found on the way.
#include "engine/run/engine.hpp"

#include <gtest/gtest.h>

namespace spheroscope::test {
namespace {

RunResult drop_with(const std::string& nodes, const std::string& stages) {
    const std::string text =
        "[cells]\narrangement = \"single\"\nradius = \"9 um\"\nnodes = " + nodes +
        R"(
[cortex.tension]
gamma = "0.5 nN/um"
[cytosol]
K = "5 kPa"
T_I = "0.115 s"
T_d = "1.15 s"
[medium]
eta_f = "0.05 kPa s"
[method]
name = "linearly_implicit"
)" + stages +
        "[measures]\nfields = []\n";
    Engine engine(scene::parse_scene(text, "drop.toml"),
                  {.threads = 1, .version = {}, .command_line = {}});
    EngineSinks sinks;
    sinks.frame = [](const SnapshotPtr&) { return std::optional<std::string>(); };
    return engine.run(sinks, std::atomic<bool>{false});
}

const std::string k_to_rest =
    "[[stage]]\nkind = \"relax\"\nnodes = 42\nuntil = \"rest\"\ncap = \"60 s\"\nevery = \"2 s\"\n";
const std::string k_for_a_second = "[[stage]]\nkind = \"relax\"\nduration = \"1 s\"\n";

TEST(Outcome, OfARelaxationForATimeIsWhatHoldsAtItsEnd) {
    EXPECT_EQ(drop_with("42", k_to_rest).outcome, "rest");
    EXPECT_EQ(drop_with("42", k_to_rest + k_for_a_second).outcome, "rest");
    EXPECT_EQ(drop_with("42", k_for_a_second).outcome, "done");
}

TEST(Outcome, OfAFinerMeshThatWasNotAskedForRestIsDone) {
    const RunResult result = drop_with("162", k_to_rest + k_for_a_second);
    EXPECT_EQ(result.verdict, RunVerdict::finished) << result.message;
    EXPECT_EQ(result.outcome, "done");
}

}  // namespace
}  // namespace spheroscope::test
