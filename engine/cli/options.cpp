#include "engine/cli/options.hpp"

#include "engine/cli/seeds.hpp"
#include "engine/contact/simd_target.hpp"
#include "engine/scene/time_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <thread>

namespace spheroscope::cli {
namespace {

std::string problem_of_path(const std::string& path) {
    return path.empty() ? "wanted a name, got nothing" : "";
}

std::string problem_of_target(const std::string& name) {
    const std::vector<std::string> targets = simd_targets();
    if (std::find(targets.begin(), targets.end(), name) != targets.end()) return "";
    return fmt::format("wanted one of {}, which this machine has, got '{}'",
                       fmt::join(targets, ", "), name);
}

void add_common_option(CommandLine& command, CommonOptions& options, CommonOption wanted) {
    switch (wanted) {
    case CommonOption::output:
        command.option("-o,--output", options.output, "file or folder to write",
                       {"PATH", problem_of_path});
        return;
    case CommonOption::output_folder:
        command.option("-o,--output", options.output, "folder to write into",
                       {"FOLDER", problem_of_folder});
        return;
    case CommonOption::threads:
        command.option("--threads", options.threads, "threads to compute with (default: all)",
                       {"N", between(1, 1024).check});
        return;
    case CommonOption::simd:
        command.option("--simd", options.simd,
                       fmt::format("instruction set of the contact kernel: {} (default: the "
                                   "first)",
                                   fmt::join(simd_targets(), ", ")),
                       {"TARGET", problem_of_target});
        return;
    case CommonOption::seed:
        command.option("--seed", options.seed, "seed of the random numbers, before the scene's",
                       {"N", problem_of_seed});
        return;
    case CommonOption::set:
        command.option("--set", options.set,
                       "change a key of the scene, for instance cells.nodes=642 or "
                       "'cortex.elastic.E=5 kPa'; may be repeated",
                       {"KEY=VALUE"});
        return;
    case CommonOption::json:
        command.flag("--json", options.json, "the result as one JSON document");
        return;
    case CommonOption::quiet:
        command.flag("--quiet", options.quiet, "only warnings and errors on stderr");
        return;
    case CommonOption::resume:
        command.flag("--resume", options.resume, "go on from the last checkpoint");
        return;
    case CommonOption::time_limit:
        command.option(
            "--time-limit", options.time_limit,
            "stop after this time, for instance '90 s' or '2 h'; a run leaves a checkpoint",
            {"TIME"});
        return;
    case CommonOption::checkpoint_every:
        command.option("--checkpoint-every", options.checkpoint_every,
                       "time between two checkpoints (default: 10 s); a run that is killed "
                       "loses no more than this",
                       {"TIME"});
        return;
    }
}

/// A span of wall time; none when the option was not given.
std::optional<double> positive_time_s(const std::string& option, const std::string& text,
                                      const std::string& example) {
    if (text.empty()) return std::nullopt;
    return scene::parse_span_s(option, text, example);
}

}  // namespace

std::string problem_of_folder(const std::string& path) {
    const std::string ending = std::filesystem::path(path).extension();
    for (const char* of_a_file : {".png", ".svg", ".pdf", ".mp4", ".h5", ".csv", ".json", ".toml"})
        if (ending == of_a_file)
            return fmt::format("wanted a folder to write into, got '{}', the name of a file", path);
    return problem_of_path(path);
}

std::vector<scene::Override> CommonOptions::overrides() const {
    std::vector<scene::Override> result;
    for (const std::string& text : set) {
        const std::size_t equals = text.find('=');
        if (equals == std::string::npos || equals == 0)
            throw Error(fmt::format("--set wants key=value, got '{}'", text),
                        "for instance --set cells.nodes=642");
        result.push_back({text.substr(0, equals), text.substr(equals + 1)});
    }
    if (seed) result.push_back({"scene.seed", std::to_string(*seed)});
    return result;
}

int CommonOptions::n_threads() const {
    if (threads > 0) return threads;
    // 0 stands for 'unknown'
    return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

std::optional<double> CommonOptions::time_limit_s() const {
    return positive_time_s("--time-limit", time_limit, "20 min");
}

std::optional<double> CommonOptions::checkpoint_every_s() const {
    return positive_time_s("--checkpoint-every", checkpoint_every, "1 min");
}

void add_common_options(CommandLine& command, CommonOptions& options,
                        std::initializer_list<CommonOption> wanted) {
    for (const CommonOption option : wanted) add_common_option(command, options, option);
}

}  // namespace spheroscope::cli
