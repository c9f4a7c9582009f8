#pragma once

#include <span>
#include <string>

namespace spheroscope::cli {

/// Sends the log to stderr, "info: ..." and "warning: ...", coloured on a terminal
/// unless NO_COLOR is set and not empty (no-color.org).
void start_log();

/// One line of the log. Only this file's source sees spdlog: its headers take seconds of every
/// source that includes them.
void log_info(const std::string& message);
void log_warning(const std::string& message);
void log_warnings(std::span<const std::string> messages);
void log_error(const std::string& message);

/// Only warnings from here on.
void make_log_quiet();

/// Writes to stderr, or nothing where that is not possible: a run of hours does not end because the
/// disk that its log goes to is full.
void print_to_stderr(const std::string& text);

/// Writes the final message of a failed run to stderr, after whatever the log still holds.
void print_error(const std::string& message);

/// Whether text on stderr may be coloured: a terminal, and NO_COLOR unset or empty.
[[nodiscard]] bool has_colour();

}  // namespace spheroscope::cli
