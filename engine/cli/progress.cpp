#include "engine/cli/progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <sys/ioctl.h>
#include <unistd.h>

namespace spheroscope::cli {
namespace {

constexpr double k_redraw_every_s = 0.1;  // as often as a person can follow
constexpr double k_line_every_s = 30.0;   // a sign of life where the fraction is not known
constexpr int k_lines_per_part = 20;      // one per 5 %
constexpr int k_bar_columns = 20;

double wall_time_s() {
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration<double>(now).count();
}

int terminal_width() {
    winsize size{};
    const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
    return known ? size.ws_col : 80;
}

/// A time step: "3.85 ms", "120 us".
std::string step_text(double seconds) {
    if (seconds >= 1.0) return fmt::format("{:.3g} s", seconds);
    if (seconds >= 1e-3) return fmt::format("{:.3g} ms", seconds * 1e3);
    return fmt::format("{:.3g} us", seconds * 1e6);
}

}  // namespace

ProgressStyle progress_style(bool quiet) {
    if (quiet) return ProgressStyle::none;
    return isatty(STDERR_FILENO) == 1 ? ProgressStyle::bar : ProgressStyle::lines;
}

std::string duration_text(double seconds) {
    if (seconds < 9.95) return fmt::format("{:.1f} s", seconds);
    const auto whole = static_cast<long long>(std::llround(seconds));
    if (whole < 60) return fmt::format("{} s", whole);
    if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
    const long long minutes = (whole + 30) / 60;
    return fmt::format("{} h {:02} min", minutes / 60, minutes % 60);
}

Progress::Progress(ProgressStyle style) : Progress(style, stderr, terminal_width(), wall_time_s) {}

Progress::Progress(ProgressStyle style, std::FILE* out, int width, Clock clock)
    : style_(style), out_(out), width_(width), clock_(std::move(clock)) {}

Progress::~Progress() { clear(); }

void Progress::update(const ProgressState& state) {
    if (style_ == ProgressStyle::none) return;
    const double now_s = clock_();
    if (!is_due(state, now_s)) return;
    shown_s_ = now_s;
    const std::string text = line_text(state, now_s);
    if (style_ == ProgressStyle::lines) {
        write(text + '\n');
    } else {
        const auto room = static_cast<std::size_t>(std::max(0, width_ - 1));
        write("\r\033[K" + text.substr(0, room));
        drawn_ = true;
    }
}

void Progress::clear() {
    if (!drawn_) return;
    write("\r\033[K");
    drawn_ = false;
}

void Progress::write(const std::string& text) {
    std::fputs(text.c_str(), out_);
    std::fflush(out_);
}

bool Progress::is_due(const ProgressState& state, double now_s) {
    const bool known = std::isfinite(state.fraction);
    const int step = known ? static_cast<int>(state.fraction * k_lines_per_part) : 0;
    if (state.part != part_) {
        part_ = state.part;
        part_begin_s_ = now_s;
        shown_step_ = step;
        return true;
    }
    if (style_ == ProgressStyle::bar) return !drawn_ || now_s - shown_s_ >= k_redraw_every_s;
    if (!known) return now_s - shown_s_ >= k_line_every_s;
    if (step <= shown_step_) return false;
    shown_step_ = step;
    return true;
}

std::string Progress::line_text(const ProgressState& state, double now_s) const {
    std::string text = fmt::format("{:<10}", state.part);
    if (std::isfinite(state.fraction)) {
        const double fraction = std::clamp(state.fraction, 0.0, 1.0);
        if (style_ == ProgressStyle::bar) {
            const auto full = static_cast<std::size_t>(fraction * k_bar_columns);
            text += fmt::format(" [{:.<{}}]", std::string(full, '#'), k_bar_columns);
        }
        text += fmt::format(" {:>3.0f} %", std::floor(100.0 * fraction));
    }
    if (std::isfinite(state.model_time_s))
        text += fmt::format("  t = {:.2f} s", state.model_time_s);
    if (std::isfinite(state.step_s)) text += fmt::format("  dt = {}", step_text(state.step_s));
    const double elapsed_s = now_s - part_begin_s_;
    if (state.fraction > 0.0 && elapsed_s > 0.0)
        text += "  ETA " + duration_text(elapsed_s * (1.0 - state.fraction) / state.fraction);
    return text;
}

}  // namespace spheroscope::cli
