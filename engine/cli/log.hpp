#pragma once

#include <string>

namespace spheroscope::cli {

/// Sends the log (spdlog's default logger) to stderr, "info: ..." and "warning: ...", coloured on a
/// terminal unless NO_COLOR is set and not empty (no-color.org).
void start_log();

/// Only warnings from here on.
void make_log_quiet();

/// Writes the final message of a failed run to stderr, after whatever the log still holds.
void print_error(const std::string& message);

/// Whether text on stderr may be coloured: a terminal, and NO_COLOR unset or empty.
[[nodiscard]] bool has_colour();

}  // namespace spheroscope::cli
