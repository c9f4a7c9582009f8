#pragma once

#include <gtest/gtest.h>
#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>
#include <sys/types.h>
#include <vector>

namespace spheroscope {

/// How a call of the program ended.
struct Outcome {
    int code = -1;   ///< exit code, or -1 if a signal ended it
    int signal = 0;  ///< that signal
    std::string out, err;
};

/// The one JSON document that stdout is to be; if it is none, the test fails. Compiled once: the
/// parser would take two seconds of every source that calls it.
[[nodiscard]] nlohmann::json json_of(const Outcome& outcome);

/// Which program a test calls. `engine` is built without pictures, as on a computer without VTK,
/// and starts in a tenth of the time: the one for verbs that draw nothing.
enum class Program { whole, engine };

/// Runs the program as a shell or a user would: as a process of its own, in a folder of its own
/// (with a space in its name) that is gone when the test is over.
class ProgramRunner : public testing::Test {
  protected:
    explicit ProgramRunner(Program program = Program::whole);
    ~ProgramRunner() override;

    /// Starts the program with these arguments; the process is this test's own child.
    [[nodiscard]] pid_t start(const std::vector<std::string>& arguments) const {
        return start(arguments, program_);
    }
    /// Waits for it to end.
    [[nodiscard]] Outcome wait_for(pid_t process) const;
    [[nodiscard]] Outcome call(const std::vector<std::string>& arguments) const {
        return wait_for(start(arguments, program_));
    }
    /// The same with the other program, for a part of a test.
    [[nodiscard]] Outcome call_with(Program program,
                                    const std::vector<std::string>& arguments) const {
        return wait_for(start(arguments, program));
    }
    /// Whether the whole program was built with pictures; asked once in a process.
    [[nodiscard]] bool has_pictures() const;
    /// A command of the shell, with $PROGRAM as the program, in the folder.
    [[nodiscard]] Outcome shell(const std::string& command) const;

    /// Writes all_stages_scene() as scene.toml and its finished run as the folder o: what
    /// `run scene.toml -o o` of the program without pictures leaves, made once in a process.
    void put_run() const;
    /// put_run(), and beside it what is no run: half a one, a checkpoint, a text, a folder. Returns
    /// their names, and one of a file that is not there.
    [[nodiscard]] std::vector<std::string> put_files_that_are_no_run() const;
    void write_file(const std::string& name, const std::string& text) const;
    [[nodiscard]] std::filesystem::path path(const std::string& name) const {
        return folder_ / name;
    }
    /// Names in a folder of the test, sorted; empty if it is not there.
    [[nodiscard]] std::vector<std::string> names_in(const std::string& name) const;
    /// Writes what was changed during a run into its file, as the panel does: "0.5 KEY VALUE".
    /// False where there is no h5py.
    [[nodiscard]] bool record_change(const std::string& run_file, const std::string& change) const;

  private:
    [[nodiscard]] pid_t start(const std::vector<std::string>& arguments, Program program) const;

    const Program program_;
    const std::filesystem::path folder_;
};

/// The same with the program that has no pictures.
class EngineRunner : public ProgramRunner {
  protected:
    EngineRunner() : ProgramRunner(Program::engine) {}
};

/// Four cells of 42 nodes through all kinds of stages; a third of a second on one core.
[[nodiscard]] std::string all_stages_scene();

/// The text with its first `what` replaced; a test that asks for something that is not there fails.
[[nodiscard]] std::string with(std::string text, const std::string& what,
                               const std::string& instead);

}  // namespace spheroscope
