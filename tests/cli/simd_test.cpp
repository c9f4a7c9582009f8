// Results are the same to the bit on any number of threads, with any kernel; the kernel is written
// down with them.
#include "engine/contact/simd_target.hpp"
#include "tests/cli/program_runner.hpp"

#include <nlohmann/json.hpp>

namespace spheroscope {
namespace {

class Simd : public EngineRunner {
  protected:
    /// A few steps of thirteen cells, so large that the second thread gets some of them.
    [[nodiscard]] nlohmann::json run(const std::string& target, const std::string& threads) const {
        const std::string folder = target + "_" + threads;
        const Outcome outcome =
            call({"run", SPHEROSCOPE_SOURCE_DIR "/scenes/bench/ball_13.toml", "--simd", target,
                  "--threads", threads, "--set", "stage[0].duration=20 ms", "-o", folder, "--json",
                  "--quiet"});
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return json_of(outcome);
    }
};

TEST_F(Simd, ARunHasTheSameBitsOnOneThreadAndOnTwoWithEveryKernelAndNamesIt) {
    for (const std::string& target : simd_targets()) {
        const nlohmann::json alone = run(target, "1"), together = run(target, "2");
        EXPECT_EQ(alone["state_hash"], together["state_hash"]) << target;
        EXPECT_EQ(alone["contact_arithmetic"], "float, " + target);
        EXPECT_EQ(together["contact_arithmetic"], "float, " + target);
    }
}

}  // namespace
}  // namespace spheroscope
