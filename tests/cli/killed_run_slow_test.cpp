// A run that is killed loses nothing that its file names, and goes on as if nothing had happened.
#include "engine/store/run_file.hpp"
#include "tests/cli/program_runner.hpp"
#include "tests/cli/same_frames.hpp"

#include <nlohmann/json.hpp>

#include <chrono>
#include <csignal>
#include <map>
#include <random>
#include <thread>

namespace spheroscope {
namespace {

namespace fs = std::filesystem;
using std::chrono::duration;
using std::chrono::steady_clock;

class KilledRun : public EngineRunner {
  protected:
    KilledRun() { write_file("scene.toml", all_stages_scene()); }

    [[nodiscard]] static std::vector<std::string> run(const std::string& folder,
                                                      const std::vector<std::string>& more = {}) {
        std::vector<std::string> arguments{
            "run",    "scene.toml",         "-o",  folder, "--threads", "1", "--quiet",
            "--json", "--checkpoint-every", "1 ms"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return arguments;
    }
    [[nodiscard]] static std::string hash_of(const Outcome& outcome) {
        return json_of(outcome).at("state_hash");
    }
    [[nodiscard]] RunFileReader reader(const std::string& folder) const {
        return RunFileReader(path(folder + "/run.h5").string());
    }
};

TEST_F(KilledRun, KeepsEveryNamedFrameAndResumesToTheSameBitsAt50RandomMoments) {
    const auto begin = steady_clock::now();
    const Outcome whole = call(run("whole"));
    const double whole_s = duration<double>(steady_clock::now() - begin).count();
    ASSERT_EQ(whole.code, 0) << whole.err;
    const RunFileReader unkilled = reader("whole");

    constexpr int n_kills = 50;
    std::mt19937 random(20210707);
    std::uniform_real_distribution<double> moment(0.0, 1.1 * whole_s);
    std::map<int, int> n_killed_in_stage;  // by the stage of the last frame; -1: no frame yet
    for (int kill_number = 0; kill_number < n_kills; ++kill_number) {
        SCOPED_TRACE("kill " + std::to_string(kill_number));
        fs::remove_all(path("killed"));
        const pid_t process = start(run("killed"));
        std::this_thread::sleep_for(duration<double>(moment(random)));
        kill(process, SIGKILL);
        const Outcome killed = wait_for(process);

        int stage = -1;
        if (fs::exists(path("killed/run.h5"))) {
            const RunFileReader left = reader("killed");
            ASSERT_LE(left.n_frames(), unkilled.n_frames());
            EXPECT_EQ(difference(left, unkilled, left.n_frames()), "");
            if (left.n_frames() > 0) stage = left.frame(left.n_frames() - 1)->stage;
        }
        if (killed.signal == SIGKILL) ++n_killed_in_stage[stage];

        const Outcome resumed = call(run("killed", {"--resume"}));
        ASSERT_EQ(resumed.code, 0) << resumed.err;
        EXPECT_EQ(hash_of(resumed), hash_of(whole));
        const RunFileReader complete = reader("killed");
        EXPECT_TRUE(complete.is_complete());
        ASSERT_EQ(complete.n_frames(), unkilled.n_frames());
        EXPECT_EQ(difference(complete, unkilled, complete.n_frames()), "");
        if (HasFailure()) return;
    }
    // Otherwise the moments have not been where they should be.
    int n_with_frames = 0, n_stages = 0;
    for (const auto& [stage, n] : n_killed_in_stage) {
        if (stage < 0) continue;
        n_with_frames += n;
        ++n_stages;
    }
    EXPECT_GE(n_with_frames, 15);
    EXPECT_GE(n_stages, 3);
}

TEST_F(KilledRun, ThatIsKilledAgainWhileItResumesStillEndsInTheSameBits) {
    const auto begin = steady_clock::now();
    const Outcome whole = call(run("whole"));
    const double whole_s = duration<double>(steady_clock::now() - begin).count();
    ASSERT_EQ(whole.code, 0) << whole.err;
    const RunFileReader unkilled = reader("whole");
    for (const double share : {0.4, 0.5, 0.6, 0.7}) {
        const pid_t process = start(run("killed", {"--resume"}));
        std::this_thread::sleep_for(duration<double>(share * whole_s));
        kill(process, SIGKILL);
        static_cast<void>(wait_for(process));
    }
    const Outcome resumed = call(run("killed", {"--resume"}));
    ASSERT_EQ(resumed.code, 0) << resumed.err;
    EXPECT_EQ(hash_of(resumed), hash_of(whole));
    EXPECT_EQ(difference(reader("killed"), unkilled, unkilled.n_frames()), "");
}

TEST_F(KilledRun, ThatWasNotKilledHasTheSameStateOnAnyNumberOfThreads) {
    std::string first;
    for (const std::string n : {"1", "2", "3", "16"}) {
        const Outcome outcome = call(
            {"run", "scene.toml", "-o", "o", "--quiet", "--json", "--overwrite", "--threads", n});
        ASSERT_EQ(outcome.code, 0) << outcome.err;
        if (first.empty()) first = hash_of(outcome);
        EXPECT_EQ(hash_of(outcome), first) << n << " threads";
    }
}

}  // namespace
}  // namespace spheroscope
