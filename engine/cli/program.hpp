#pragma once

#include "engine/cli/verb.hpp"

#include <span>
#include <string>
#include <vector>

namespace spheroscope::cli {

/// Opens those of stdin, stdout and stderr that are closed, as nohup and daemons leave them: the
/// next file of the program would get their number, and a line of the log would end up in a run.
void open_standard_streams();

/// Runs the verb that `arguments` (without the program's name) begin with, or answers --help and
/// --version. Results go to stdout; every failure becomes one message on stderr and the exit code
/// that belongs to it, so nothing is thrown.
[[nodiscard]] ExitCode run_program(const std::vector<std::string>& arguments,
                                   std::span<const Verb> verbs, const std::string& version);

/// "spheroscope check 'my scene.toml' --json": quoted where a shell would need it.
[[nodiscard]] std::string command_line_text(const std::vector<std::string>& arguments);

}  // namespace spheroscope::cli
