// What bad_input_test.cpp asks of the program without pictures, asked of the verbs that draw.
#include "tests/cli/program_runner.hpp"

namespace spheroscope {
namespace {

using BadInputOfPictures = ProgramRunner;

TEST_F(BadInputOfPictures, OfAFileThatIsNoRunIsRefusedByEveryReader) {
    if (!has_pictures()) GTEST_SKIP() << "built without pictures";
    const std::vector<std::string> no_runs = put_files_that_are_no_run();
    for (const std::string verb : {"render", "movie", "export", "figures"})
        for (const std::string& name : no_runs) {
            SCOPED_TRACE(verb + " " + name);
            const Outcome outcome = call({verb, name});
            EXPECT_EQ(outcome.code, 2) << outcome.err;
            EXPECT_EQ(outcome.out, "");
            EXPECT_NE(outcome.err.find("error: "), std::string::npos) << outcome.err;
            EXPECT_NE(outcome.err.find(name), std::string::npos) << outcome.err;
        }
}

}  // namespace
}  // namespace spheroscope
