// What bad_input_test.cpp asks of the program without pictures, asked of the verbs that draw.
#include "tests/cli/program_runner.hpp"

namespace spheroscope {
namespace {

namespace fs = std::filesystem;

using BadInputOfPictures = ProgramRunner;

TEST_F(BadInputOfPictures, OfAFileThatIsNoRunIsRefusedByEveryReader) {
    if (!has_pictures()) GTEST_SKIP() << "built without pictures";
    put_run();
    fs::copy_file(path("o/run.h5"), path("cut.h5"));
    fs::resize_file(path("cut.h5"), fs::file_size(path("cut.h5")) / 2);
    fs::copy_file(path("o/run.checkpoint.h5"), path("foreign.h5"));
    write_file("text.h5", "not HDF5 at all");
    fs::create_directory(path("folder.h5"));
    for (const std::string verb : {"render", "movie", "export", "figures"})
        for (const std::string name :
             {"cut.h5", "foreign.h5", "text.h5", "folder.h5", "missing.h5"}) {
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
