#include "engine/cli/log.hpp"

#include <fmt/format.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <unistd.h>

namespace spheroscope::cli {

bool has_colour() {
    const char* const no_color = std::getenv("NO_COLOR");
    return isatty(STDERR_FILENO) == 1 && (no_color == nullptr || *no_color == '\0');
}

void start_log() {
    const auto sink = std::make_shared<spdlog::sinks::stderr_color_sink_mt>(
        has_colour() ? spdlog::color_mode::always : spdlog::color_mode::never);
    const auto logger = std::make_shared<spdlog::logger>("spheroscope", sink);
    logger->set_pattern("%^%l%$: %v");
    spdlog::set_default_logger(logger);
}

void log_info(const std::string& message) { spdlog::info("{}", message); }
void log_warning(const std::string& message) { spdlog::warn("{}", message); }
void log_warnings(std::span<const std::string> messages) {
    for (const std::string& message : messages) log_warning(message);
}
void log_error(const std::string& message) { spdlog::error("{}", message); }

void make_log_quiet() { spdlog::set_level(spdlog::level::warn); }

void print_to_stderr(const std::string& text) { std::fputs(text.c_str(), stderr); }

void print_error(const std::string& message) {
    spdlog::default_logger()->flush();
    print_to_stderr(has_colour() ? fmt::format("\033[31m{}\033[0m\n", message) : message + '\n');
}

}  // namespace spheroscope::cli
