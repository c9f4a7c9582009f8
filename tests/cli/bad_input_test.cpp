// Whatever is wrong with the input: one message that says where, the right exit code, and nothing
// is written.
#include "engine/store/run_file.hpp"
#include "tests/cli/program_runner.hpp"

#include <nlohmann/json.hpp>

namespace spheroscope {
namespace {

namespace fs = std::filesystem;

class BadInput : public EngineRunner {
  protected:
    /// Runs the scene; it must be refused with the code, at the place, with these words.
    void expect_refused(const std::string& scene, const std::string& place,
                        const std::string& words, int code = 2) const {
        SCOPED_TRACE(words);
        write_file("scene.toml", scene);
        const Outcome outcome = call({"run", "scene.toml", "-o", "o", "--quiet"});
        EXPECT_EQ(outcome.code, code) << outcome.err;
        EXPECT_EQ(outcome.out, "");
        EXPECT_TRUE(outcome.err.starts_with(place + ": error: ")) << outcome.err;
        EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
        EXPECT_FALSE(fs::exists(path("o")));
    }
    /// The same for a call without a place in a scene.
    void expect_refused(const std::vector<std::string>& arguments, const std::string& words,
                        Program program = Program::engine) const {
        SCOPED_TRACE(words);
        const Outcome outcome = call_with(program, arguments);
        EXPECT_EQ(outcome.code, 2) << outcome.err;
        EXPECT_EQ(outcome.out, "");
        EXPECT_NE(outcome.err.find("error: "), std::string::npos) << outcome.err;
        EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
    }
    static std::string changed(const std::string& what, const std::string& instead) {
        return with(all_stages_scene(), what, instead);
    }
    /// The scene with its cells at these rows of x, y, z, radius instead of packed ones.
    static std::string with_centres(const std::string& rows) {
        std::string text = changed("arrangement = \"packing\"\ncount = 4",
                                   "arrangement = \"centres\"\ncentres = " + rows);
        const std::size_t anneal = text.find("[[stage]]\nkind = \"anneal\"");
        return text.erase(anneal, text.find("[[stage]]\nkind = \"compact\"") - anneal);
    }
};

TEST_F(BadInput, InAnyKeyOfASceneIsRefusedAtItsPlace) {
    expect_refused(changed("seed = 3", "sed = 3"), "scene.toml:3:1", "seed");
    expect_refused(changed("\"20 kPa\"", "\"20 um\""), "scene.toml:14:5", "20 um");
    expect_refused(changed("count = 4", "count = 0"), "scene.toml:7:9", "count");
    expect_refused(changed("count = 4", "count = -1"), "scene.toml:7:9", "count");
    expect_refused(changed("nodes = 42", "nodes = 43"), "scene.toml:8:9", "43");
    expect_refused(changed("omega = \"0.5", "omega = \"1.5"), "scene.toml:36:1",
                   "allow_full_wetting");
    expect_refused(changed("\"linearly_implicit\"", "\"leapfrog\""), "scene.toml:43:1",
                   "there is no method 'leapfrog'");
    expect_refused(changed("\"sigma_nn\"", "\"sigma_mm\""), "scene.toml:73:1",
                   "there is no field 'sigma_mm'");
    expect_refused(changed("size = [320, 200]", "size = [321, 200]"), "scene.toml:79:9", "321");
}

TEST_F(BadInput, OfAFieldWithoutItsPartNamesTheMissingTable) {
    std::string text = changed("[cortex.elastic]\nE = \"20 kPa\"\n\n[cortex.bending]\n",
                               "[cortex.bending]\nE = \"20 kPa\"\n");
    expect_refused(text, "scene.toml:71:1", "the scene has no [cortex.elastic]");
}

TEST_F(BadInput, OfAnExpectedMeasureThatDoesNotExistIsRefusedBeforeTheRun) {
    expect_refused(all_stages_scene() + "\n[expect]\nbeauty = { min = 1 }\n", "scene.toml:82:1",
                   "there is no measure 'beauty'");
}

TEST_F(BadInput, IsFoundByCheckAsWell) {
    for (const std::string& text :
         {changed("\"linearly_implicit\"", "\"leapfrog\""), changed("\"sigma_nn\"", "\"sigma_mm\""),
          all_stages_scene() + "\n[expect]\nbeauty = { min = 1 }\n"}) {
        write_file("scene.toml", text);
        const Outcome outcome = call({"check", "scene.toml", "--json"});
        EXPECT_EQ(outcome.code, 2) << outcome.err;
        EXPECT_EQ(json_of(outcome)["valid"], false);
    }
}

TEST_F(BadInput, OfCentresWithinEachOtherNamesTheCells) {
    expect_refused(with_centres("[[0, 0, 0, 9], [0, 0, 1, 9]]"), "scene.toml:5:1",
                   "cells 0 and 1 overlap");
    EXPECT_EQ(call({"check", "scene.toml"}).code, 2);
}

TEST_F(BadInput, InThePictureOfASceneIsRefusedThere) {
    expect_refused(changed("field = \"sigma_h\"", "field = \"sigma_g\""), "scene.toml:76:1",
                   "picture.field: there is no field 'sigma_g'");
    expect_refused(changed("[[picture]]", "[[pictures]]"), "scene.toml:76:3",
                   "did you mean [[picture]]?");
    expect_refused(changed("[320, 200]", "[32, 32]"), "scene.toml:79:9", "64 ... 4096");
}

TEST_F(BadInput, OfOptionsThatMeanNothingThereIsNotIgnored) {
    write_file("scene.toml", all_stages_scene());
    expect_refused({"run", "scene.toml", "-o", "x.h5"}, "a folder to write into, got 'x.h5'");
    expect_refused({"run", "scene.toml", "--time-limit", ""}, "--time-limit: wanted a value");
    expect_refused({"inspect", "run.h5", "--contact", ""}, "--contact: wanted a value");
    expect_refused({"run", "scene.toml", "--seed", "99999999999999999999"}, "at most 18 digits");
    expect_refused({"precision", "scene.toml", "--most-nodes", "162"}, "--most-nodes is about");
    expect_refused({"precision", "scene.toml", "--mesh", "--levels", "3"}, "--levels is about");
    expect_refused({"reproduce", "no.claims", "--stored"}, "no.claims: cannot be read");
    expect_refused({"pull-off", "scene.toml", "--rate", "nan"}, "wanted a number, got 'nan'");
    EXPECT_FALSE(fs::exists(path("x.h5")));
}

TEST_F(BadInput, OnTheCommandLineIsRefusedByOneMessage) {
    write_file("scene.toml", all_stages_scene());
    write_file("a file", "text");
    expect_refused({"run", "missing.toml"}, "missing.toml");
    expect_refused({"run", "scene.toml", "--threads", "0"}, "--threads");
    expect_refused({"run", "scene.toml", "-o", ""}, "--output");
    expect_refused({"run", "scene.toml", "-o", "a file"}, "a file: cannot make this folder");
    expect_refused({"run", "scene.toml", "-o", "a file/o"}, "cannot make this folder");
    expect_refused({"run", "scene.toml", "--set", "nonsense"}, "--set wants key=value");
    expect_refused({"run", "scene.toml", "--set", "cells.nose=42"}, "cells.nose");
    expect_refused({"run", "scene.toml", "--time-limit", "soon"}, "--time-limit");
    expect_refused({"run", "scene.toml", "--checkpoint-every", "0 s"}, "--checkpoint-every");
    EXPECT_FALSE(fs::exists(path("out")));
}

TEST_F(BadInput, OfChangesToARunThatIsThereIsNotIgnored) {
    if (!has_pictures()) GTEST_SKIP() << "built without pictures";
    put_run();
    for (const std::string verb : {"render", "movie"})
        expect_refused({verb, "o/run.h5", "--set", "contact.adhesion.omega=0.1"},
                       "--set contact.adhesion.omega means nothing to a run that is there",
                       Program::whole);
    expect_refused({"movie", "o/run.h5", "--seed", "5"}, "--seed means nothing", Program::whole);
    expect_refused({"render", "o/run.h5", "--frame", "3", "--frames", "1,2"}, "exclude each other",
                   Program::whole);
    expect_refused({"movie", "o/run.h5", "-o", "x.mp4"}, "a folder to write into, got 'x.mp4'",
                   Program::whole);
}

// Of the verbs that draw: bad_input_slow_test.cpp
TEST_F(BadInput, OfAFileThatIsNoRunIsRefusedByInfoAndByAScene) {
    for (const std::string& name : put_files_that_are_no_run()) {
        expect_refused({"info", name}, name);
        const std::string cells = "arrangement = \"file\"\nfile = \"" + name + "\"";
        std::string text = changed("arrangement = \"packing\"\ncount = 4", cells);
        const std::size_t anneal = text.find("[[stage]]\nkind = \"anneal\"");
        text.erase(anneal, text.find("[[stage]]\nkind = \"compact\"") - anneal);
        fs::rename(path("o"), path("kept"));
        expect_refused(text, "scene.toml:5:1", name);
        fs::rename(path("kept"), path("o"));
    }
}

TEST_F(BadInput, OfAFileThatIsNoRunIsNotOverwritten) {
    write_file("scene.toml", all_stages_scene());
    fs::create_directory(path("o"));
    write_file("o/run.h5", "somebody's only copy");
    EXPECT_EQ(call({"run", "scene.toml", "-o", "o", "--quiet"}).code, 2);
    EXPECT_EQ(fs::file_size(path("o/run.h5")), 20U);
}

TEST_F(BadInput, OfTooManyCellsForAPackingEndsWith3AndTheReason) {
    write_file("scene.toml", with(changed("count = 4", "count = 13"), "packing_fraction = 0.4",
                                  "packing_fraction = 0.60"));
    const Outcome outcome = call({"run", "scene.toml", "-o", "o", "--quiet"});
    EXPECT_EQ(outcome.code, 3);
    EXPECT_NE(outcome.err.find("scene.toml:47:1: touching beads overlap by"), std::string::npos)
        << outcome.err;
    const RunFileReader reader(path("o/run.h5").string());
    EXPECT_EQ(reader.outcome(), "not packed");
    EXPECT_FALSE(reader.is_complete());
}

TEST_F(BadInput, OfAStepFarTooLargeEndsWith3NamesTheCellAndLeavesTheLastGoodState) {
    write_file("scene.toml", changed("name = \"linearly_implicit\"\ndt_max = \"0.1 s\"",
                                     "name = \"forward_euler\"\ndt = \"0.5 s\""));
    const Outcome outcome = call({"run", "scene.toml", "-o", "o", "--quiet"});
    EXPECT_EQ(outcome.code, 3) << outcome.err;
    EXPECT_NE(outcome.err.find("cell "), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("scene.toml:43:1"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("the last good state is in o/run.checkpoint.h5"), std::string::npos)
        << outcome.err;
    // It is a state to go on from: the same step fails again.
    const Outcome again = call({"run", "scene.toml", "-o", "o", "--quiet", "--resume"});
    EXPECT_EQ(again.code, 3);
    EXPECT_EQ(again.err, outcome.err);
}

TEST_F(BadInput, OfAFullStdoutEndsWith5HoweverLongTheResultIs) {
    for (const char* verb : {"--version", "man"}) {
        const Outcome outcome = shell(std::string("exec \"$PROGRAM\" ") + verb + " > /dev/full");
        EXPECT_EQ(outcome.code, 5) << verb << outcome.err;
        EXPECT_NE(outcome.err.find("could not be written to stdout"), std::string::npos) << verb;
    }
}

TEST_F(BadInput, InWhatIsChangedOfARepeatedRunNamesTheSceneInItsFile) {
    put_run();
    expect_refused({"run", "o/run.h5", "-o", "again", "--set", "contact.adhesion.omega=1.5 nN/um"},
                   "scene in o/run.h5:");
    expect_refused({"run", "o/run.h5", "--resume"}, "to go on with this run, give its scene");
}

TEST_F(BadInput, OfAFolderThatCannotBeMadeIsOfTheDiskUnlessAFileHasItsName) {
    write_file("scene.toml", all_stages_scene());
    const Outcome outcome = call({"run", "scene.toml", "-o", "/proc/no/folder"});
    EXPECT_EQ(outcome.code, 5) << outcome.err;
    EXPECT_NE(outcome.err.find("-o chooses another one"), std::string::npos) << outcome.err;
}

TEST_F(BadInput, OfCellsFromAFileIsFoundByCheckAsWell) {
    put_run();
    const Outcome pair = call({"extract", "o/run.h5", "--contact", "0-1", "-o", "pair.toml"});
    ASSERT_EQ(pair.code, 0) << pair.err;
    ASSERT_EQ(call({"check", "pair.toml"}).code, 0);
    expect_refused({"check", "pair.toml", "--set", "cells.file=nosuch.h5"}, "nosuch.h5");
    expect_refused({"check", "pair.toml", "--set", "cells.frame=999"}, "no cells can be had");
    expect_refused({"check", "pair.toml", "--set", "cells.nodes=162"}, "have 42 nodes");
}

TEST_F(BadInput, OfAClosedStdoutEndsWith5) {
    const Outcome outcome = shell("exec \"$PROGRAM\" --version >&-");
    EXPECT_EQ(outcome.code, 5) << outcome.err;
    EXPECT_NE(outcome.err.find("could not be written to stdout"), std::string::npos);
}

// The log is lost then, and nothing else: neither the run, whose file would have the number of a
// closed stderr, nor the exit code.
TEST_F(BadInput, OfAStderrThatTakesNothingChangesNothing) {
    write_file("scene.toml", all_stages_scene());
    const auto hash = json_of(call({"run", "scene.toml", "-o", "o0", "--json"}))["state_hash"];
    int n = 0;
    for (const std::string where : {"2>&-", "2>/dev/full", "2>&- <&-"}) {
        const std::string folder = "o" + std::to_string(++n);
        const Outcome run =
            shell("exec \"$PROGRAM\" run scene.toml -o " + folder + " --json " + where);
        EXPECT_EQ(run.code, 0) << where;
        EXPECT_EQ(json_of(run)["state_hash"], hash) << where;
        EXPECT_EQ(call({"info", folder + "/run.h5"}).code, 0) << where;
        EXPECT_EQ(shell("exec \"$PROGRAM\" info nosuch.h5 " + where).code, 2) << where;
        EXPECT_EQ(shell("exec \"$PROGRAM\" --nosuch " + where).code, 2) << where;
    }
}

TEST_F(BadInput, OfASceneThatIsALinkToItselfIsRefused) {
    fs::create_symlink("loop.toml", path("loop.toml"));
    expect_refused({"check", "loop.toml"}, "cannot open the scene");
}

TEST_F(BadInput, OfAFullDiskLeavesNoHalfReport) {
    const Outcome outcome = shell("ulimit -f 2; exec \"$PROGRAM\" bench --cells 13 --nodes 162 "
                                  "--repetitions 1 --quiet -o b");
    EXPECT_EQ(outcome.code, 5) << outcome.err;
    EXPECT_NE(outcome.err.find("b/bench.csv: the report could not be written"), std::string::npos)
        << outcome.err;
    EXPECT_EQ(names_in("b"), std::vector<std::string>{});
}

TEST_F(BadInput, OfAFullDiskEndsWith5AndTheReasonAndKeepsEveryFrameBefore) {
    write_file("scene.toml", all_stages_scene());
    ASSERT_EQ(call({"run", "scene.toml", "-o", "whole", "--quiet"}).code, 0);
    const auto whole = fs::file_size(path("whole/run.h5"));
    // ulimit -f counts blocks of 512 bytes
    const Outcome outcome = shell("ulimit -f " + std::to_string(whole / 2 / 512) +
                                  "; exec \"$PROGRAM\" run scene.toml -o o --quiet");
    EXPECT_EQ(outcome.code, 5) << outcome.err;
    EXPECT_NE(outcome.err.find("store: o/run.h5: error: cannot"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("ulimit -f"), std::string::npos) << outcome.err;
    const RunFileReader reader(path("o/run.h5").string());
    EXPECT_GT(reader.n_frames(), 5);
    EXPECT_LT(reader.n_frames(), 24);
    EXPECT_EQ(reader.frame(reader.n_frames() - 1)->x_um.size(), 4U * 42U * 3U);
    EXPECT_FALSE(reader.is_complete());
    for (const std::string& name : names_in("o"))
        EXPECT_TRUE(name == "run.h5" || name == "run.checkpoint.h5" ||
                    name == "run.checkpoint.1.h5")
            << name;
    // With room again it goes on.
    EXPECT_EQ(call({"run", "scene.toml", "-o", "o", "--quiet", "--resume"}).code, 0);
    EXPECT_EQ(RunFileReader(path("o/run.h5").string()).n_frames(), 24);
}

}  // namespace
}  // namespace spheroscope
