#include "tests/cli/program_runner.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <sys/wait.h>
#include <unistd.h>

namespace spheroscope {
namespace {

namespace fs = std::filesystem;

std::string file_of(Program program) {
    return SPHEROSCOPE_BINARY_DIR +
           std::string(program == Program::whole ? "/spheroscope" : "/spheroscope_engine");
}

const std::string k_out = ".out.txt", k_err = ".err.txt";

std::string read_text(const fs::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

void send_to(int descriptor, const std::string& path, int flags) {
    const int file = open(path.c_str(), flags, 0666);
    if (file < 0 || dup2(file, descriptor) < 0) _exit(126);
    close(file);
}

/// A name for a folder that is gone when the process ends.
class KeptFolder {
  public:
    KeptFolder()
        : path_(fs::path(testing::TempDir()) / ("spheroscope kept " + std::to_string(getpid()))) {
        fs::remove_all(path_);
    }
    ~KeptFolder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    KeptFolder(const KeptFolder&) = delete;
    KeptFolder& operator=(const KeptFolder&) = delete;
    [[nodiscard]] const fs::path& path() const { return path_; }

  private:
    fs::path path_;
};

}  // namespace

nlohmann::json json_of(const Outcome& outcome) {
    nlohmann::json document = nlohmann::json::parse(outcome.out, nullptr, false);
    if (document.is_discarded())
        ADD_FAILURE() << "not one JSON document: " << outcome.out << outcome.err;
    return document;
}

ProgramRunner::ProgramRunner(Program program)
    : program_(program),
      folder_(fs::path(testing::TempDir()) / ("spheroscope run " + std::to_string(getpid()))) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
}

ProgramRunner::~ProgramRunner() {
    std::error_code ignored;  // the message of the test matters more
    fs::remove_all(folder_, ignored);
}

pid_t ProgramRunner::start(const std::vector<std::string>& arguments, Program program) const {
    std::vector<std::string> words = arguments;
    const bool is_shell = !words.empty() && words.front() == "/bin/sh";
    if (!is_shell) words.insert(words.begin(), file_of(program));
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    const pid_t process = fork();
    if (process != 0) return process;
    if (chdir(folder_.c_str()) != 0) _exit(126);
    send_to(STDIN_FILENO, "/dev/null", O_RDONLY);
    send_to(STDOUT_FILENO, k_out, O_WRONLY | O_CREAT | O_TRUNC);
    send_to(STDERR_FILENO, k_err, O_WRONLY | O_CREAT | O_TRUNC);
    execv(argv[0], argv.data());
    _exit(127);
}

Outcome ProgramRunner::wait_for(pid_t process) const {
    int status = 0;
    EXPECT_EQ(waitpid(process, &status, 0), process);
    Outcome outcome;
    if (WIFEXITED(status)) outcome.code = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) outcome.signal = WTERMSIG(status);
    outcome.out = read_text(folder_ / k_out);
    outcome.err = read_text(folder_ / k_err);
    return outcome;
}

bool ProgramRunner::has_pictures() const {
    static const bool has =
        call_with(Program::whole, {"--help"}).out.find("\n  movie ") != std::string::npos;
    return has;
}

Outcome ProgramRunner::shell(const std::string& command) const {
    return call({"/bin/sh", "-c", "PROGRAM='" + file_of(program_) + "'; " + command});
}

void ProgramRunner::put_run() const {
    static const KeptFolder kept;
    write_file("scene.toml", all_stages_scene());
    if (!fs::exists(kept.path())) {
        ASSERT_EQ(call_with(Program::engine, {"run", "scene.toml", "-o", "o", "--quiet"}).code, 0);
        fs::copy(folder_ / "o", kept.path(), fs::copy_options::recursive);
    } else {
        fs::copy(kept.path(), folder_ / "o", fs::copy_options::recursive);
    }
}

std::vector<std::string> ProgramRunner::put_files_that_are_no_run() const {
    put_run();
    fs::copy_file(path("o/run.h5"), path("cut.h5"));
    fs::resize_file(path("cut.h5"), fs::file_size(path("cut.h5")) / 2);
    fs::copy_file(path("o/run.checkpoint.h5"), path("foreign.h5"));
    write_file("text.h5", "not HDF5 at all");
    fs::create_directory(path("folder.h5"));
    return {"cut.h5", "foreign.h5", "text.h5", "folder.h5", "missing.h5"};
}

void ProgramRunner::write_file(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
}

bool ProgramRunner::record_change(const std::string& run_file, const std::string& change) const {
    const Outcome written =
        shell("/usr/bin/python3 -c 'import h5py' 2>/dev/null || exit 77; /usr/bin/python3 -c '"
              "import h5py, numpy\n"
              "file = h5py.File(\"" +
              run_file +
              "\", \"r+\")\n"
              "file.create_dataset(\"changes\", data=numpy.bytes_(\"" +
              change + "\\n\"))'");
    EXPECT_TRUE(written.code == 0 || written.code == 77) << written.err;
    return written.code == 0;
}

std::vector<std::string> ProgramRunner::names_in(const std::string& name) const {
    std::vector<std::string> names;
    if (!fs::is_directory(folder_ / name)) return names;
    for (const auto& entry : fs::directory_iterator(folder_ / name))
        names.push_back(entry.path().filename());
    std::sort(names.begin(), names.end());
    return names;
}

std::string all_stages_scene() {
    return R"([scene]
title = "Four cells through every kind of stage"
seed = 3

[cells]
arrangement = "packing"
count = 4
nodes = 42

[cortex]
thickness = "200 nm"

[cortex.elastic]
E = "20 kPa"

[cortex.bending]

[cortex.tension]
gamma = "0.5 nN/um"

[cortex.viscosity]
eta = "1 kPa s"

[cytosol]
controller = "pid"
K = "5 kPa"

[medium]
eta_f = "0.05 kPa s"

[contact]
law = "traction"
h0 = "0.3 um"
omega_reading = "text"

[contact.adhesion]
omega = "0.5 nN/um"

[contact.friction]
normal = "0.05 kPa s/um"
tangential = "0.05 kPa s/um"

[method]
name = "linearly_implicit"
dt_max = "0.1 s"

[[stage]]
kind = "anneal"
packing_fraction = 0.4
steps = 2000
frames = 5

[[stage]]
kind = "compact"
duration = "1 s"
every = "0.2 s"

[[stage]]
kind = "hold"
duration = "0.5 s"
every = "0.1 s"

[[stage]]
kind = "release"
duration = "0.5 s"
every = "0.1 s"

[[stage]]
kind = "relax"
duration = "2 s"
every = "0.5 s"

[measures]
fields = ["sigma_h", "sigma_nn", "gamma_eff"]

[[picture]]
name = "main"
field = "sigma_h"
size = [320, 200]
)";
}

std::string with(std::string text, const std::string& what, const std::string& instead) {
    const std::size_t place = text.find(what);
    EXPECT_NE(place, std::string::npos) << what;
    if (place != std::string::npos) text.replace(place, what.size(), instead);
    return text;
}

}  // namespace spheroscope
