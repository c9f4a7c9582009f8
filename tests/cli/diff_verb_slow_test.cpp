// `diff` as a script uses it: the exit code is the verdict. (What it compares is tested by
// tests/render/image_diff_test.cpp; starting the program so often is what takes time here.)
#include "tests/cli/program_runner.hpp"

#include <nlohmann/json.hpp>

#include <filesystem>

namespace spheroscope {
namespace {

namespace fs = std::filesystem;

class DiffVerb : public ProgramRunner {
  protected:
    void SetUp() override {
        if (!has_pictures()) GTEST_SKIP() << "built without pictures";
        for (const std::string name : {"square", "square_moved", "square_other", "black", "white"})
            fs::copy_file(fs::path(SPHEROSCOPE_SOURCE_DIR) / "tests/cli/pictures" / (name + ".png"),
                          path(name + ".png"));
    }
    nlohmann::json diff(std::vector<std::string> arguments, int code) const {
        arguments.insert(arguments.begin(), "diff");
        arguments.push_back("--json");
        const Outcome outcome = call(arguments);
        EXPECT_EQ(outcome.code, code) << outcome.out << outcome.err;
        return json_of(outcome);
    }
};

TEST_F(DiffVerb, OfEqualPicturesEndsWith0AndOfDifferentOnesWith4) {
    EXPECT_EQ(diff({"square.png", "square.png"}, 0)["equal"], true);
    const nlohmann::json other = diff({"square.png", "square_other.png"}, 4);
    EXPECT_EQ(other["equal"], false);
    EXPECT_EQ(other["reasons"].size(), 2U) << other;
    EXPECT_EQ(other["max_difference"], 100);
    EXPECT_EQ(call({"diff", "square.png", "square_other.png"}).out.find("different: "), 0U);
}

TEST_F(DiffVerb, ToleratesWhatItIsToldToTolerate) {
    diff({"square.png", "square_moved.png"}, 4);
    diff({"square.png", "square_moved.png", "--tolerance", "0"}, 0);
    diff({"square.png", "square_other.png", "--tolerance", "0"}, 4);
    diff({"square.png", "square_other.png", "--tolerance", "0.2"}, 0);
    diff({"square.png", "square_other.png", "--threshold", "100", "--tolerance", "0"}, 0);
    diff({"square.png", "square_other.png", "--similarity", "0.5"}, 0);
    diff({"square.png", "square_other.png", "--similarity", "0.9999"}, 4);
}

TEST_F(DiffVerb, NeverCallsTwoPicturesOfNothingEqual) {
    for (const std::string name : {"black.png", "white.png"})
        EXPECT_EQ(diff({name, name}, 4)["reasons"].size(), 2U) << name;
}

TEST_F(DiffVerb, WritesASheetAlsoWhenThePicturesDiffer) {
    diff({"square.png", "square_other.png", "-o", "sheet.png"}, 4);
    EXPECT_TRUE(fs::exists(path("sheet.png")));
    EXPECT_EQ(call({"diff", "sheet.png", "sheet.png"}).code, 0);
}

TEST_F(DiffVerb, DoesNotReplaceAPictureThatItReads) {
    for (const std::string name : {"square.png", "./square_other.png"}) {
        const auto written = fs::last_write_time(path(name));
        const Outcome outcome = call({"diff", "square.png", "square_other.png", "-o", name});
        EXPECT_EQ(outcome.code, 2);
        EXPECT_NE(outcome.err.find(name + ": this file is read here"), std::string::npos)
            << outcome.err;
        EXPECT_EQ(fs::last_write_time(path(name)), written);
    }
}

TEST_F(DiffVerb, OfPicturesThatCannotBeComparedSaysWhy) {
    diff({"square.png", "square_other.png", "-o", "sheet.png"}, 4);
    const Outcome sizes = call({"diff", "square.png", "sheet.png"});
    EXPECT_EQ(sizes.code, 4);
    EXPECT_NE(sizes.err.find("64 x 48 and 208 x 88"), std::string::npos) << sizes.err;
    EXPECT_EQ(diff({"square.png", "sheet.png"}, 4)["equal"], false);
    write_file("text.png", "no picture");
    for (const std::string name : {"text.png", "missing.png"}) {
        const Outcome outcome = call({"diff", "square.png", name});
        EXPECT_EQ(outcome.code, 2);
        EXPECT_NE(outcome.err.find(name), std::string::npos) << outcome.err;
    }
}

}  // namespace
}  // namespace spheroscope
