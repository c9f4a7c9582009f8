// A movie that is interrupted, or cannot be made, leaves its finished pictures and nothing by
// halves.
#include "engine/store/run_file.hpp"
#include "tests/cli/program_runner.hpp"

#include <nlohmann/json.hpp>

#include <chrono>
#include <csignal>
#include <fstream>
#include <iterator>
#include <thread>

namespace spheroscope {
namespace {

namespace fs = std::filesystem;

class InterruptedMovie : public ProgramRunner {
  protected:
    void SetUp() override {
        if (!has_pictures()) GTEST_SKIP() << "built without pictures";
        write_file("scene.toml", all_stages_scene());
        ASSERT_EQ(call({"run", "scene.toml", "-o", "o", "--quiet"}).code, 0);
    }
    /// Every picture that is there is a whole one, and nothing else is there.
    void expect_only_pictures(std::size_t n_at_most) const {
        const std::vector<std::string> names = names_in("o/frames/main");
        EXPECT_LE(names.size(), n_at_most);
        for (const std::string& name : names) EXPECT_TRUE(name.ends_with(".png")) << name;
    }
};

TEST_F(InterruptedMovie, WithoutFfmpegEndsWith5AndKeepsAllPictures) {
    const Outcome outcome = shell("PATH=/nowhere exec \"$PROGRAM\" movie scene.toml -o o --quiet");
    EXPECT_EQ(outcome.code, 5) << outcome.err;
    EXPECT_NE(outcome.err.find("ffmpeg"), std::string::npos) << outcome.err;
    EXPECT_EQ(names_in("o/frames/main").size(), 24U);
    expect_only_pictures(24);
    EXPECT_FALSE(fs::exists(path("o/main.mp4")));
}

TEST_F(InterruptedMovie, WithoutFfmpegStillTellsWhatTheRunHasComeTo) {
    const std::string call =
        "PATH=/nowhere exec \"$PROGRAM\" movie scene.toml -o new --overwrite --quiet";
    const Outcome document = shell(call + " --json");
    EXPECT_EQ(document.code, 5) << document.err;
    EXPECT_NE(document.err.find("ffmpeg"), std::string::npos) << document.err;
    EXPECT_EQ(json_of(document)["run"]["frames"], 24);
    EXPECT_TRUE(json_of(document)["movies"].empty());
    const Outcome text = shell(call);
    EXPECT_EQ(text.code, 5) << text.err;
    EXPECT_NE(text.out.find("new/run.h5"), std::string::npos) << text.out;
}

TEST_F(InterruptedMovie, WhileItDrawsEndsWith130And143AndGoesOnWithThePicturesItHas) {
    for (const auto& [signal, code] : {std::pair{SIGINT, 130}, std::pair{SIGTERM, 143}}) {
        fs::remove_all(path("o/frames"));
        const pid_t process = start({"movie", "scene.toml", "-o", "o", "--quiet"});
        for (int i = 0; i < 2000 && names_in("o/frames/main").size() < 3; ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        kill(process, signal);
        const Outcome outcome = wait_for(process);
        EXPECT_EQ(outcome.code, code) << outcome.err;
        EXPECT_NE(outcome.out.find("none: stopped after "), std::string::npos) << outcome.out;
        EXPECT_NE(outcome.out.find(" of 24 pictures"), std::string::npos) << outcome.out;
        expect_only_pictures(23);
        EXPECT_FALSE(fs::exists(path("o/main.mp4")));
    }
    const std::size_t n_there = names_in("o/frames/main").size();
    const Outcome movie = call({"movie", "scene.toml", "-o", "o", "--quiet", "--json"});
    EXPECT_EQ(movie.code, 0) << movie.err;
    EXPECT_TRUE(fs::exists(path("o/main.mp4")));
    EXPECT_EQ(json_of(movie)["movies"][0]["drawn"], 24 - n_there);
}

TEST_F(InterruptedMovie, OfARunWithoutFramesIsRefused) {
    const std::string run = path("o/run.h5").string();
    const auto header = RunFileReader(run).header();
    static_cast<void>(RunFileWriter::append(run, *header, 0));
    const Outcome outcome = call({"movie", "o/run.h5", "--quiet"});
    EXPECT_EQ(outcome.code, 2) << outcome.out;
    EXPECT_NE(outcome.err.find("no frame to make a movie of"), std::string::npos) << outcome.err;
}

TEST_F(InterruptedMovie, ThatIsKilledGoesOnToTheSameFileToTheByte) {
    const auto bytes = [this](const std::string& name) {
        std::ifstream file(path(name), std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(file), {});
    };
    ASSERT_EQ(call({"movie", "scene.toml", "-o", "o", "--quiet"}).code, 0);
    const std::string whole = bytes("o/main.mp4"), picture = bytes("o/frames/main/000020.png");
    ASSERT_GT(whole.size(), 1000U);
    fs::remove(path("o/main.mp4"));
    fs::remove_all(path("o/frames"));
    const pid_t process = start({"movie", "scene.toml", "-o", "o", "--quiet"});
    for (int i = 0; i < 2000 && names_in("o/frames/main").size() < 3; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    kill(process, SIGKILL);
    EXPECT_EQ(wait_for(process).signal, SIGKILL);
    EXPECT_FALSE(fs::exists(path("o/main.mp4")));
    ASSERT_EQ(call({"movie", "scene.toml", "-o", "o", "--quiet"}).code, 0);
    EXPECT_TRUE(bytes("o/main.mp4") == whole);
    EXPECT_TRUE(bytes("o/frames/main/000020.png") == picture);
    for (const std::string& name : names_in("o")) EXPECT_FALSE(name.ends_with(".partial")) << name;
}

TEST_F(InterruptedMovie, OfARunThatIsNotThereYetIsNotDrawnUntilTheRunIsFinished) {
    write_file("endless.toml", with(all_stages_scene(), "duration = \"2 s\"\nevery = \"0.5 s\"",
                                    "duration = \"100000 s\"\nevery = \"0.5 s\""));
    const Outcome outcome =
        call({"movie", "endless.toml", "-o", "e", "--quiet", "--time-limit", "0.1 s"});
    EXPECT_EQ(outcome.code, 3) << outcome.err;
    EXPECT_FALSE(fs::exists(path("e/frames")));
    EXPECT_FALSE(fs::exists(path("e/main.mp4")));
    EXPECT_EQ(call({"movie", "endless.toml", "-o", "e", "--quiet"}).code, 2);  // unfinished
}

TEST_F(InterruptedMovie, DrawsThePicturesOfTheSceneThatIsGivenNotOfTheRun) {
    write_file("scene.toml", with(all_stages_scene(), "name = \"main\"", "name = \"other\""));
    const Outcome outcome = call({"movie", "scene.toml", "-o", "o", "--quiet"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_TRUE(fs::exists(path("o/other.mp4")));
    EXPECT_FALSE(fs::exists(path("o/main.mp4")));
}

}  // namespace
}  // namespace spheroscope
