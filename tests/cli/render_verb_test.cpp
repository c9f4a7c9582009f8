// `render` and `export` on a run's file: which frame, and where pictures and files go.
#include "tests/cli/program_runner.hpp"
#include "tests/reports/stretched_cell.hpp"

namespace spheroscope {
namespace {

/// Three frames, in the folder that the program is called in.
class RenderVerb : public ProgramRunner {
  protected:
    void SetUp() override {
        if (!has_pictures()) GTEST_SKIP() << "built without pictures";
        write_file("small.toml", stretched_cell_text("0.02 s", "dt = \"5 ms\"\n") +
                                     "every = \"0.01 s\"\n[[picture]]\nsize = [320, 180]\n");
        const Outcome run = call_with(Program::engine, {"run", "small.toml", "--quiet", "-o", "."});
        ASSERT_EQ(run.code, 0) << run.err;
    }
};

TEST_F(RenderVerb, APictureIsDrawnBesideARunInTheSameFolder) {
    const Outcome outcome = call({"render", "run.h5"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_TRUE(std::filesystem::exists(path("main_000002.png"))) << outcome.out;
}

TEST_F(RenderVerb, OneFrameIsExportedWhereOneWasAskedForAndElseAll) {
    ASSERT_EQ(call({"export", "run.h5", "--frame", "-2"}).code, 0);
    const std::vector<std::string> one{"cells.pvd", "cells_000001.vtp", "network.pvd",
                                       "network_000001.vtp"};
    EXPECT_EQ(names_in("paraview"), one);
    ASSERT_EQ(call({"export", "run.h5", "-o", "all"}).code, 0);
    EXPECT_EQ(names_in("all").size(), 2U + 2U * 3U);
}

TEST_F(RenderVerb, AFrameThatIsNotThereIsRefusedWithThoseThatAre) {
    for (const std::string verb : {"render", "export"}) {
        const Outcome outcome = call({verb, "run.h5", "--frame", "3"});
        EXPECT_EQ(outcome.code, 2);
        EXPECT_NE(outcome.err.find("run.h5: there is no frame 3"), std::string::npos)
            << outcome.err;
        EXPECT_NE(outcome.err.find("frames are 0 to 2"), std::string::npos) << outcome.err;
    }
}

TEST_F(RenderVerb, WhatIsRefusedLeavesNoFolder) {
    for (const std::vector<std::string>& refused :
         {std::vector<std::string>{"--picture", "none"}, {"--frames", "0,7"}, {"--frame", "3"}}) {
        std::vector<std::string> arguments{"render", "run.h5", "-o", "stills"};
        arguments.insert(arguments.end(), refused.begin(), refused.end());
        EXPECT_EQ(call(arguments).code, 2);
        EXPECT_FALSE(std::filesystem::exists(path("stills"))) << refused[0];
    }
    ASSERT_EQ(call({"render", "run.h5", "-o", "stills", "--frames", "0,-1"}).code, 0);
    EXPECT_EQ(names_in("stills"), std::vector<std::string>{"main_strip.png"});
}

}  // namespace
}  // namespace spheroscope
