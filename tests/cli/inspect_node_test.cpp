// `inspect --node` from the outside: numbers, picture, and what it refuses.
#include "tests/cli/program_runner.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace spheroscope {
namespace {

class InspectNode : public ProgramRunner {
  protected:
    void SetUp() override { put_run(); }
    void expect_refused(std::vector<std::string> arguments, const std::string& words) const {
        arguments.insert(arguments.begin(), {"inspect", "o/run.h5"});
        const Outcome outcome = call_with(Program::engine, arguments);
        EXPECT_EQ(outcome.code, 2) << outcome.err;
        EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
    }
};

TEST_F(InspectNode, DrawsWhatItPrints) {
    if (!has_pictures()) GTEST_SKIP() << "built without pictures";
    const Outcome outcome =
        call({"inspect", "o/run.h5", "--node", "1:3", "--json", "--quiet", "-o", "node.png"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(json_of(outcome)["node"]["node"], 3);
    std::ifstream file(path("node.png"), std::ios::binary);
    std::string start(8, '\0');
    file.read(start.data(), 8);
    EXPECT_EQ(start.substr(1, 3), "PNG");
    EXPECT_GT(std::filesystem::file_size(path("node.png")), 20000U);
}

TEST_F(InspectNode, RefusesPicturesThatItDoesNotMake) {
    expect_refused({"-o", "x.png"}, "--contact 17-42 or --node 17:203");
    expect_refused({"--node", "1:3", "-o", "x.mp4"}, "picture sheet (.png)");
    expect_refused({"--node", "1:3", "--contact", "0-1", "-o", "x.png"},
                   "either the contact or the node");
    expect_refused({"--node", "1:3", "--step", "-o", "x.png"}, "--step has tables");
    expect_refused({"--node", "1:9999", "-o", "x.png"}, "there is no node 9999");
    EXPECT_FALSE(std::filesystem::exists(path("x.png")));
}

}  // namespace
}  // namespace spheroscope
