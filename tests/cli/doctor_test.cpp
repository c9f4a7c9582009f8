#include "engine/cli/doctor.hpp"
#include "tests/cli/program_runner.hpp"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <map>

namespace spheroscope {
namespace {

class Doctor : public ProgramRunner {
  protected:
    static std::map<std::string, nlohmann::json> parts_of(const Outcome& outcome) {
        const nlohmann::json document = json_of(outcome);
        std::map<std::string, nlohmann::json> parts;
        for (const nlohmann::json& part : document["parts"]) parts[part["name"]] = part;
        return parts;
    }
};

TEST_F(Doctor, SaysWhatTheProgramHasAndNeeds) {
    const Outcome outcome = call({"doctor", "--json"});
    EXPECT_EQ(outcome.code, 0) << outcome.out;
    const nlohmann::json document = json_of(outcome);
    EXPECT_EQ(document["well"], true);
    EXPECT_GE(document["threads"], 1);
    EXPECT_EQ(document["simd"]["used"], document["simd"]["available"][0]);
    auto parts = parts_of(outcome);
    EXPECT_EQ(parts["opengl"]["is_there"], has_pictures());
    EXPECT_EQ(parts.contains("ffmpeg"), has_pictures());
    EXPECT_NE(call_with(Program::engine, {"doctor"}).out.find("\nopengl "), std::string::npos);
}

TEST_F(Doctor, EndsWith5WhereSomethingIsMissingAndNamesIt) {
    if (!has_pictures()) GTEST_SKIP() << "built without pictures";
    const Outcome outcome = shell("PATH=/nowhere exec \"$PROGRAM\" doctor --json");
    EXPECT_EQ(outcome.code, 5) << outcome.err;
    auto parts = parts_of(outcome);
    EXPECT_EQ(parts["ffmpeg"]["is_there"], false);
    EXPECT_EQ(parts["opengl"]["is_there"], true);
}

TEST(Display, IsTriedAndNotTakenForGranted) {
    using cli::find_display;
    EXPECT_FALSE(find_display("", false, true).is_there);
    EXPECT_NE(find_display("", false, true).text.find("xvfb-run"), std::string::npos);
    EXPECT_NE(find_display("", false, false).text.find("Debian: xvfb"), std::string::npos);
    EXPECT_TRUE(find_display("", true, false).is_there);
    const cli::Finding silent = find_display(":4711.0", false, false);
    EXPECT_FALSE(silent.is_there);
    EXPECT_NE(silent.text.find("nothing answers"), std::string::npos);
    EXPECT_FALSE(find_display("nonsense", false, false).is_there);
    EXPECT_NE(find_display("far:0", false, false).text.find("not tried"), std::string::npos);
}

}  // namespace
}  // namespace spheroscope
