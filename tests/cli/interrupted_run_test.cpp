// Signals, time limits, and what becomes of a run that is there already.
#include "engine/store/run_file.hpp"
#include "tests/cli/program_runner.hpp"
#include "tests/cli/same_frames.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <thread>

namespace spheroscope {
namespace {

namespace fs = std::filesystem;

using Words = std::vector<std::string>;

class InterruptedRun : public EngineRunner {
  protected:
    InterruptedRun() {
        write_file("scene.toml", all_stages_scene());
        // The last stage would take hours: nothing but a signal ends this one in time.
        write_file("endless.toml",
                   with(with(all_stages_scene(), "duration = \"2 s\"\nevery = \"0.5 s\"",
                             "duration = \"100000 s\"\nevery = \"0.5 s\""),
                        "dt_max = \"0.1 s\"", "dt_max = \"0.1 s\"\ntolerance = \"0 um\""));
    }
    /// Waits until the run in `folder` has `n` frames.
    void wait_for_frames(const std::string& folder, int n) const {
        const std::string file = path(folder + "/run.h5").string();
        for (int i = 0; i < 2000; ++i) {
            if (fs::exists(file) && RunFileReader(file).n_frames() >= n) return;
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        FAIL() << "no " << n << " frames came";
    }
    [[nodiscard]] static std::string hash_of(const Outcome& outcome) {
        return json_of(outcome).at("state_hash");
    }
};

TEST_F(InterruptedRun, EndsWithTheCodeOfTheSignalAfterACheckpoint) {
    for (const auto& [signal, code] :
         {std::pair{SIGHUP, 129}, std::pair{SIGINT, 130}, std::pair{SIGTERM, 143}}) {
        const std::string folder = std::to_string(code);
        const pid_t process =
            start({"run", "endless.toml", "-o", folder, "--quiet", "--threads", "1"});
        wait_for_frames(folder, 6);
        kill(process, signal);
        const Outcome outcome = wait_for(process);
        EXPECT_EQ(outcome.code, code) << outcome.err;
        EXPECT_NE(outcome.out.find("outcome              stopped\n"), std::string::npos);
        EXPECT_TRUE(fs::exists(path(folder + "/run.checkpoint.h5")));
        const RunFileReader reader(path(folder + "/run.h5").string());
        EXPECT_EQ(reader.outcome(), "stopped");
        EXPECT_FALSE(reader.is_complete());
    }
}

TEST_F(InterruptedRun, UnderNohupGoesOnAfterAHangUp) {
    const Outcome outcome =
        shell("trap '' HUP; \"$PROGRAM\" run scene.toml -o o --quiet & pid=$!; "
              "until [ -e o/run.h5 ]; do sleep 0.01; done; kill -HUP $pid; wait $pid");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(RunFileReader(path("o/run.h5").string()).outcome(), "done");
}

TEST_F(InterruptedRun, IsNotMadeAgainOnceItIsFinishedUnlessItWouldBeAnother) {
    const auto again = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"run", "scene.toml", "-o", "o"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome outcome = call(arguments);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return outcome.err.find("nothing is left to do") == std::string::npos;
    };
    EXPECT_TRUE(again({})) << "there is none yet";
    // Of a program that differs from its commit nobody knows whether it is the same one.
    const bool is_known = call({"--version"}).out.find("+changes") == std::string::npos;
    EXPECT_EQ(again({}), !is_known);
    EXPECT_TRUE(again({"--overwrite"}));
    EXPECT_TRUE(again({"--simd", "scalar"})) << "other bits";
}

TEST_F(InterruptedRun, ThatIsResumedEndsInTheSameBits) {
    const Outcome whole = call({"run", "scene.toml", "-o", "whole", "--quiet", "--json"});
    ASSERT_EQ(whole.code, 0) << whole.err;
    const pid_t process = start({"run", "scene.toml", "-o", "o", "--quiet", "--threads", "1"});
    wait_for_frames("o", 3);
    kill(process, SIGINT);
    static_cast<void>(wait_for(process));
    const Outcome resumed = call({"run", "scene.toml", "-o", "o", "--quiet", "--json", "--resume"});
    ASSERT_EQ(resumed.code, 0) << resumed.err;
    EXPECT_EQ(hash_of(resumed), hash_of(whole));
    const RunFileReader a(path("whole/run.h5").string()), b(path("o/run.h5").string());
    ASSERT_EQ(a.n_frames(), b.n_frames());
    EXPECT_EQ(difference(a, b, a.n_frames()), "");
}

TEST_F(InterruptedRun, EndsAtOnceWithASecondSignalOfEitherKind) {
    // Steps of this run are long, so that the first signal still waits for the end of one when the
    // second comes; where it does not, the run has stopped in good order, and another try follows.
    write_file("slow.toml", with(all_stages_scene(), "nodes = 42", "nodes = 2562"));
    int n_tries = 0;
    for (const int second : {SIGINT, SIGTERM}) {
        Outcome outcome;
        for (int i = 0; i < 10 && outcome.signal == 0; ++i) {
            const std::string folder = std::to_string(++n_tries);
            const pid_t process = start({"run", "slow.toml", "-o", folder, "--quiet"});
            wait_for_frames(folder, 5);
            kill(process, SIGINT);
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
            kill(process, second);
            outcome = wait_for(process);
        }
        EXPECT_EQ(outcome.signal, second);
    }
}

TEST_F(InterruptedRun, IsNotOverwrittenUnlessOneSaysSo) {
    const pid_t process =
        start({"run", "endless.toml", "-o", "o", "--quiet", "--checkpoint-every", "1 h"});
    wait_for_frames("o", 3);
    kill(process, SIGKILL);  // before any checkpoint but those between stages
    static_cast<void>(wait_for(process));
    const int n_frames = RunFileReader(path("o/run.h5").string()).n_frames();
    const Outcome refused = call({"run", "scene.toml", "-o", "o", "--quiet"});
    EXPECT_EQ(refused.code, 2);
    EXPECT_EQ(refused.err,
              "error: o/run.h5: an unfinished run is there\n"
              "  hint: --resume goes on with it, --overwrite begins anew, -o writes elsewhere\n");
    EXPECT_EQ(RunFileReader(path("o/run.h5").string()).n_frames(), n_frames);
    const Outcome other = call({"run", "scene.toml", "-o", "o", "--quiet", "--resume"});
    EXPECT_EQ(other.code, 2);  // the run of another scene
    EXPECT_EQ(RunFileReader(path("o/run.h5").string()).n_frames(), n_frames);
    EXPECT_EQ(call({"run", "scene.toml", "-o", "o", "--resume", "--overwrite"}).code, 2);
    const Outcome anew = call({"run", "scene.toml", "-o", "o", "--quiet", "--overwrite"});
    EXPECT_EQ(anew.code, 0) << anew.err;
    EXPECT_TRUE(RunFileReader(path("o/run.h5").string()).is_complete());
}

TEST_F(InterruptedRun, ThatIsFinishedIsNotOverwrittenByAnotherScene) {
    const auto run = [this](const std::vector<std::string>& more) {
        std::vector<std::string> words{"run", "scene.toml", "-o", "o", "--quiet"};
        words.insert(words.end(), more.begin(), more.end());
        return call(words);
    };
    ASSERT_EQ(run({}).code, 0);
    const Outcome refused = run({"--set", "cortex.elastic.E=10 kPa"});
    EXPECT_EQ(refused.code, 2);
    EXPECT_NE(refused.err.find("o/run.h5: the finished run of another scene or seed is there"),
              std::string::npos)
        << refused.err;
    EXPECT_EQ(run({"--seed", "77"}).code, 2);
    EXPECT_EQ(run({"--set", "picture[0].size=[640,360]"}).code, 0) << "the same run";
    EXPECT_EQ(run({"--seed", "77", "--overwrite"}).code, 0);
    EXPECT_EQ(RunFileReader(path("o/run.h5").string()).header()->seed, 77U);
}

TEST_F(InterruptedRun, ThatWasChangedOnItsWayIsNotOverwrittenByTheSceneAsItStands) {
    ASSERT_EQ(call({"run", "scene.toml", "-o", "o", "--quiet"}).code, 0);
    if (!record_change("o/run.h5", "0.5 contact.adhesion.omega 0.2")) GTEST_SKIP() << "no h5py";
    const Outcome refused = call({"run", "scene.toml", "-o", "o", "--quiet"});
    EXPECT_EQ(refused.code, 2);
    EXPECT_NE(refused.err.find("a finished run that was changed on its way is there"),
              std::string::npos)
        << refused.err;
    EXPECT_EQ(call({"run", "scene.toml", "-o", "o", "--quiet", "--overwrite"}).code, 0);
}

TEST_F(InterruptedRun, ThatIsFinishedSaysSoWhenItIsResumed) {
    const Outcome whole = call({"run", "scene.toml", "-o", "o", "--quiet", "--json"});
    ASSERT_EQ(whole.code, 0) << whole.err;
    const auto written = fs::last_write_time(path("o/run.h5"));
    const Outcome again = call({"run", "scene.toml", "-o", "o", "--json", "--resume"});
    EXPECT_EQ(again.code, 0);
    EXPECT_EQ(again.err, "info: o/run.h5: this run is finished; nothing is left to do "
                         "(--overwrite makes it again)\n");
    EXPECT_EQ(hash_of(again), hash_of(whole));
    EXPECT_EQ(json_of(again)["totals"], json_of(whole)["totals"]);
    EXPECT_EQ(fs::last_write_time(path("o/run.h5")), written);
    const Outcome other =
        call({"run", "scene.toml", "-o", "o", "--quiet", "--resume", "--seed", "8"});
    EXPECT_EQ(other.code, 2) << other.err;
}

TEST_F(InterruptedRun, ThatIsFinishedNeedsNoCheckpoint) {
    const Outcome whole = call({"run", "scene.toml", "-o", "o", "--quiet", "--json"});
    ASSERT_EQ(whole.code, 0) << whole.err;
    const auto resume = [this] {
        return call({"run", "scene.toml", "-o", "o", "--json", "--resume"});
    };
    const std::string nothing_left = "info: o/run.h5: this run is finished; nothing is left to do "
                                     "(--overwrite makes it again)\n";
    for (const std::string& name : names_in("o"))
        if (name.find("checkpoint") != std::string::npos) write_file("o/" + name, "damaged");
    const Outcome damaged = resume();
    EXPECT_EQ(damaged.code, 0);
    EXPECT_EQ(damaged.err, nothing_left);
    EXPECT_EQ(hash_of(damaged), hash_of(whole));
    for (const std::string& name : names_in("o"))
        if (name.find("checkpoint") != std::string::npos) fs::remove(path("o/" + name));
    const Outcome gone = resume();
    EXPECT_EQ(gone.err, nothing_left);
    EXPECT_EQ(hash_of(gone), hash_of(whole));

    // as an earlier version left it
    const Outcome change = shell("/usr/bin/python3 -c 'import h5py' 2>/dev/null || exit 77; "
                                 "/usr/bin/python3 -c '"
                                 "import h5py\n"
                                 "del h5py.File(\"o/run.h5\", \"r+\").attrs[\"state_hash\"]\n'");
    if (change.code == 77) GTEST_SKIP() << "no h5py";
    ASSERT_EQ(change.code, 0) << change.err;
    const Outcome old = resume();
    EXPECT_EQ(old.code, 0) << old.err;
    EXPECT_TRUE(json_of(old).at("state_hash").is_null());
    const Outcome in_words = call({"run", "scene.toml", "-o", "o", "--quiet", "--resume"});
    EXPECT_NE(in_words.out.find("state hash           not known"), std::string::npos)
        << in_words.out;
}

TEST_F(InterruptedRun, GoesOnWithOtherPictures) {
    const Outcome stopped =
        call({"run", "scene.toml", "-o", "o", "--quiet", "--time-limit", "1 ms"});
    ASSERT_EQ(stopped.code, 3) << stopped.err;
    const Outcome resumed = call({"run", "scene.toml", "-o", "o", "--quiet", "--resume", "--set",
                                  "picture[0].size=[640,360]"});
    EXPECT_EQ(resumed.code, 0) << resumed.err;
    EXPECT_TRUE(RunFileReader(path("o/run.h5").string()).is_complete());
}

TEST_F(InterruptedRun, StopsAtItsTimeLimitWithACheckpointAndCode3) {
    const Outcome outcome =
        call({"run", "endless.toml", "-o", "o", "--quiet", "--time-limit", "0.2 s"});
    EXPECT_EQ(outcome.code, 3) << outcome.err;
    EXPECT_NE(outcome.out.find("outcome              time limit\n"), std::string::npos);
    EXPECT_TRUE(fs::exists(path("o/run.checkpoint.h5")));
    const Outcome more =
        call({"run", "endless.toml", "-o", "o", "--quiet", "--time-limit", "0.1 s", "--resume"});
    EXPECT_EQ(more.code, 3) << more.err;
}

}  // namespace
}  // namespace spheroscope
