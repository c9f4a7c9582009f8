// A run's file in other people's programs: h5py, and what ParaView reads. (That VTK's own reader
// gives back every number of an export is tested in tests/render/export_test.cpp.)
#include "tests/cli/program_runner.hpp"

#include <nlohmann/json.hpp>

#include <cstdlib>
#include <filesystem>

namespace spheroscope {
namespace {

namespace fs = std::filesystem;

class OpeningElsewhere : public ProgramRunner {
  protected:
    void SetUp() override { put_run(); }
    /// The output of a script under Debian's python3; nothing where that has no h5py.
    [[nodiscard]] Outcome python(const std::string& script, const std::string& argument) const {
        return shell(
            "/usr/bin/python3 -c 'import h5py' 2>/dev/null || exit 77; /usr/bin/python3 '" +
            (fs::path(SPHEROSCOPE_SOURCE_DIR) / script).string() + "' " + argument);
    }
};

TEST_F(OpeningElsewhere, TheExampleWithH5pyPrintsWhatInfoSays) {
    const Outcome outcome = python("engine/store/read_run.py", "o/run.h5");
    if (outcome.code == 77) GTEST_SKIP() << "no h5py";
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const nlohmann::json info = json_of(call_with(Program::engine, {"info", "o/run.h5", "--json"}));
    EXPECT_NE(outcome.out.find("Four cells through every kind of stage: 4 cells, seed 3"),
              std::string::npos)
        << outcome.out;
    std::size_t n_times = 0;
    for (std::size_t at = 0; (at = outcome.out.find("\nt = ", at)) != std::string::npos; ++at)
        ++n_times;
    EXPECT_EQ(n_times, info["frames"].get<std::size_t>());
    char area[64];
    std::snprintf(area, sizeof(area), "contact area %g um^2\nextent",
                  info["totals"]["contact_area"].get<double>());
    EXPECT_NE(outcome.out.find(area), std::string::npos) << area << "\n" << outcome.out;
    EXPECT_NE(outcome.out.find("sigma_nn: mean "), std::string::npos) << outcome.out;
}

TEST_F(OpeningElsewhere, TheXdmfNamesDatasetsThatH5pyFinds) {
    const Outcome outcome = python("tests/cli/check_xdmf.py", "o/run.xdmf");
    if (outcome.code == 77) GTEST_SKIP() << "no h5py";
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.out.find("24 "), 0U) << outcome.out << "frames, arrays";
}

// Debian's VTK is built without these readers; its ParaView has them.
TEST_F(OpeningElsewhere, TheXdmfIsReadByBothReadersOfVtk) {
    const Outcome outcome = shell(
        "command -v pvpython >/dev/null || exit 77; pvpython '" +
        (fs::path(SPHEROSCOPE_SOURCE_DIR) / "tests/cli/check_xdmf_with_vtk.py").string() + "' o");
    if (outcome.code == 77) GTEST_SKIP() << "no ParaView";
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_GT(std::atoi(outcome.out.c_str()), 50) << outcome.out << "arrays";
}

TEST_F(OpeningElsewhere, ExportWritesAFileForEachFrameAndACollection) {
    if (!has_pictures()) GTEST_SKIP() << "built without pictures";
    fs::remove(path("o/run.xdmf"));
    const Outcome outcome = call({"export", "o/run.h5", "-o", "p", "--json"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(json_of(outcome)["frames"], 24);
    EXPECT_EQ(names_in("p").size(), 24U + 24U + 2U);
    EXPECT_TRUE(fs::exists(path("o/run.xdmf"))) << "made anew where it was lost";
    EXPECT_EQ(call({"export", "o/run.h5", "-o", "q", "--frame", "-1"}).code, 0);
    EXPECT_EQ(names_in("q"), (std::vector<std::string>{"cells.pvd", "cells_000023.vtp",
                                                       "network.pvd", "network_000023.vtp"}));
    const Outcome refused = call({"export", "o/run.h5", "--frame", "24"});
    EXPECT_EQ(refused.code, 2);
    EXPECT_NE(refused.err.find("frames are 0 to 23"), std::string::npos) << refused.err;
}

}  // namespace
}  // namespace spheroscope
