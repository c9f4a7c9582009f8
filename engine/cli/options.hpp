#pragma once

#include "engine/cli/command_line.hpp"
#include "engine/scene/scene.hpp"

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

namespace spheroscope::cli {

/// The options that several verbs share. A verb takes some of them; all mean the same everywhere.
enum class CommonOption {
    output,  ///< a file, or what the verb says
    output_folder,
    threads,
    simd,
    seed,
    set,
    json,
    quiet,
    resume,
    time_limit,
    checkpoint_every
};

struct CommonOptions {
    std::string output;                 ///< file or folder to write; empty: the verb's own choice
    int threads = 0;                    ///< as given; 0: not given
    std::string simd;                   ///< SIMD target of the kernels; empty: the best
    std::optional<std::uint64_t> seed;  ///< instead of the scene's
    std::vector<std::string> set;       ///< "key=value", as given
    bool json = false;                  ///< one JSON document on stdout
    bool quiet = false;                 ///< no progress, no information; warnings and errors only
    bool resume = false;                ///< go on from the last checkpoint
    std::string time_limit;             ///< as given, "20 min"; empty: none
    std::string checkpoint_every;       ///< as given, "10 s"; empty: the engine's own choice

    /// What --set and --seed change in the scene; the seed last, so that it wins. Throws Error when
    /// one is not of the form key=value.
    [[nodiscard]] std::vector<scene::Override> overrides() const;

    /// --threads, or as many as this process may use at once.
    [[nodiscard]] int n_threads() const;

    /// --time-limit in seconds of wall time; none when not given. Throws Error when it is not a
    /// positive time.
    [[nodiscard]] std::optional<double> time_limit_s() const;

    /// --checkpoint-every in seconds of wall time, in the same way.
    [[nodiscard]] std::optional<double> checkpoint_every_s() const;
};

/// Declares the wanted options on a verb's command line; `options` must live until it is read.
void add_common_options(CommandLine& command, CommonOptions& options,
                        std::initializer_list<CommonOption> wanted);

/// What is wrong with the name of a folder to write into: it is empty, or looks like that of a
/// file; "" if nothing is.
[[nodiscard]] std::string problem_of_folder(const std::string& path);

}  // namespace spheroscope::cli
