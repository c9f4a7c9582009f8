// A picture can be drawn again from what its own file says, with its run or without.
#include "tests/cli/program_runner.hpp"

#include <nlohmann/json.hpp>

#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace spheroscope {
namespace {

namespace fs = std::filesystem;

class VerifiedMovie : public ProgramRunner {
  protected:
    void SetUp() override {
        if (!has_pictures()) GTEST_SKIP() << "built without pictures";
        write_file("scene.toml", all_stages_scene());
        ASSERT_EQ(call({"movie", "scene.toml", "-o", "o", "--quiet", "--set",
                        "picture[0].plot=contact_area"})
                      .code,
                  0);
    }
    nlohmann::json verify(std::vector<std::string> arguments, int code) const {
        arguments.insert(arguments.begin(), {"movie", "--json", "--quiet", "--verify"});
        const Outcome outcome = call(arguments);
        EXPECT_EQ(outcome.code, code) << outcome.out << outcome.err;
        return json_of(outcome);
    }
};

TEST_F(VerifiedMovie, FindsItsRunOrSimulatesItAnew) {
    const nlohmann::json found = verify({"o/frames/main/000020.png"}, 0);
    EXPECT_EQ(found["frame"], 20);
    EXPECT_EQ(found["max_difference"], 0);
    EXPECT_EQ(found["every_bit_counts"], true);
    EXPECT_TRUE(found["run"].is_string());
    fs::copy_file(path("o/frames/main/000020.png"), path("lone.png"));
    for (const std::string option : {"--no-png", "--overwrite", "--resume"}) {
        const Outcome idle = call({"movie", "--verify", "o/frames/main/000020.png", option});
        EXPECT_EQ(idle.code, 2);
        EXPECT_NE(idle.err.find(option + " means nothing with --verify"), std::string::npos)
            << idle.err;
    }
    const Outcome idle = call({"movie", "o/run.h5", "--time-limit", "1 s"});
    EXPECT_EQ(idle.code, 2);
    EXPECT_NE(idle.err.find("--time-limit means nothing to a run that is there"), std::string::npos)
        << idle.err;
    EXPECT_EQ(verify({"lone.png", "o/run.h5"}, 0)["max_difference"], 0);
    const nlohmann::json anew = verify({"lone.png"}, 0);
    EXPECT_TRUE(anew["run"].is_null());
    EXPECT_EQ(anew["max_difference"], 0);
}

TEST_F(VerifiedMovie, OfAnotherRunIsRefused) {
    ASSERT_EQ(call({"render", "o/run.h5", "--frame", "20", "-o", "o"}).code, 0);
    EXPECT_EQ(verify({"o/main_000020.png"}, 0)["frame"], 20);
    ASSERT_EQ(call({"run", "scene.toml", "-o", "p", "--quiet", "--seed", "4"}).code, 0);
    const Outcome refused = call({"movie", "--verify", "o/main_000020.png", "p/run.h5"});
    EXPECT_EQ(refused.code, 2) << "another run is no base for a verdict";
    EXPECT_NE(refused.err.find("not of this run"), std::string::npos) << refused.err;
}

TEST_F(VerifiedMovie, OfARunThatWasChangedSaysSoAndIsSimulatedWithItsChanges) {
    fs::copy(path("o"), path("c"), fs::copy_options::recursive);
    if (!record_change("c/run.h5", "0.5 contact.adhesion.omega 0.45")) GTEST_SKIP() << "no h5py";
    const Outcome changed = call({"run", "c/run.h5", "-o", "changed", "--quiet"});
    ASSERT_EQ(changed.code, 0) << changed.out << changed.err;
    ASSERT_EQ(call({"render", "changed/run.h5", "-o", "alone"}).code, 0);
    ASSERT_EQ(names_in("alone").size(), 1U);
    const std::string picture = "alone/" + names_in("alone").front();
    const Outcome texts = shell("strings -n 8 " + picture);
    EXPECT_NE(texts.out.find("contact.adhesion.omega 0.45"), std::string::npos) << texts.out;
    EXPECT_EQ(verify({picture}, 0)["max_difference"], 0) << "simulated anew";
    EXPECT_EQ(verify({picture, "changed/run.h5"}, 0)["max_difference"], 0);
    const Outcome refused = call({"movie", "--verify", picture, "o/run.h5"});
    EXPECT_EQ(refused.code, 2);
    EXPECT_NE(refused.err.find("something else was changed on its way"), std::string::npos)
        << refused.err;
}

TEST_F(VerifiedMovie, OfTwoRunsSideBySideIsVerifiedWithBoth) {
    ASSERT_EQ(call({"run", "scene.toml", "-o", "p", "--quiet", "--seed", "4"}).code, 0);
    ASSERT_EQ(call({"movie", "o/run.h5", "--compare", "p/run.h5", "-o", "o", "--quiet"}).code, 0);
    EXPECT_TRUE(fs::exists(path("o/main_compared.mp4")));
    EXPECT_EQ(verify({"o/frames/main_compared/000010.png", "--compare", "p/run.h5"}, 0)["frame"],
              10);
    const Outcome refused = call({"movie", "--verify", "o/frames/main_compared/000010.png"});
    EXPECT_EQ(refused.code, 2);
    EXPECT_NE(refused.err.find("--compare"), std::string::npos) << refused.err;
}

/// Width of a PNG, from its header.
int width_px(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::array<unsigned char, 20> head{};
    in.read(reinterpret_cast<char*>(head.data()), head.size());
    return (head[16] << 24) | (head[17] << 16) | (head[18] << 8) | head[19];
}

TEST_F(VerifiedMovie, FramesBesideEachOtherAreOnePicture) {
    ASSERT_EQ(call({"render", "o/run.h5", "--frame", "20", "-o", "o"}).code, 0);
    const Outcome strip = call({"render", "o/run.h5", "--frames", "anneal,20,-1", "-o", "o"});
    ASSERT_EQ(strip.code, 0) << strip.err;
    EXPECT_EQ(width_px(path("o/main_strip.png")), 3 * width_px(path("o/main_000020.png")));
    EXPECT_EQ(verify({"o/main_strip.png"}, 0)["max_difference"], 0);
    // the picture's file has the command that has drawn it, below the pictures too, and the run's
    std::ifstream in(path("o/main_strip.png"), std::ios::binary);
    const std::string file{std::istreambuf_iterator<char>(in), {}};
    const auto holds = [&](const std::string& words) {
        return file.find(words) != std::string::npos;
    };
    const std::string command = " render o/run.h5 --frames anneal,20,-1 -o o";
    const std::size_t named = file.find(command), again = file.find(command, named + 1);
    ASSERT_NE(named, std::string::npos);
    EXPECT_NE(again, std::string::npos);
    for (const char* words :
         {"Run command", "Caption", "; one range in all pictures", "\"heading\":\"a  seeding\""})
        EXPECT_TRUE(holds(words)) << words;
    std::string many = "0";
    for (int i = 0; i < 200; ++i) many += ",0";
    const Outcome too_wide = call({"render", "o/run.h5", "--frames", many, "-o", "o"});
    EXPECT_EQ(too_wide.code, 2);
    EXPECT_NE(too_wide.err.find("201 pictures of"), std::string::npos) << too_wide.err;
    EXPECT_EQ(call({"movie", "--verify", "o/main_strip.png", "--compare", "o/run.h5"}).code, 2);
    const Outcome refused = call({"render", "o/run.h5", "--frames", "anneal,fly", "-o", "o"});
    EXPECT_EQ(refused.code, 2);
    EXPECT_NE(refused.err.find("got 'fly'"), std::string::npos) << refused.err;
    EXPECT_NE(refused.err.find("anneal"), std::string::npos) << refused.err;
    EXPECT_EQ(call({"render", "o/run.h5", "--frames", "100000", "-o", "o"}).code, 2);
}

}  // namespace
}  // namespace spheroscope
