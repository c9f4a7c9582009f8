#pragma once

#include <cstdio>
#include <functional>
#include <string>

namespace spheroscope::cli {

/// How progress is shown: a bar that is drawn over itself (terminal), a line per 5 % (log file), or
/// not at all.
enum class ProgressStyle { bar, lines, none };

/// A bar when stderr is a terminal, lines when it is not, nothing with --quiet.
[[nodiscard]] ProgressStyle progress_style(bool quiet);

/// A span of wall time for people: "0.3 s", "12 s", "2 min 05 s", "3 h 12 min".
[[nodiscard]] std::string duration_text(double seconds);

/// Where the work stands. What is not known is NaN and not shown.
struct ProgressState {
    std::string part;     ///< what is being done: "compact", "pictures"
    double fraction;      ///< of this part, 0..1; NaN: nobody knows how long it takes
    double model_time_s;  ///< NaN: the work has no model time
    double step_s;        ///< last time step; NaN: none
};

/// Shows how far a piece of work is, on stderr:
///
///     compact    [##########..........]  52 %  t = 6.61 s  dt = 3.8 ms  ETA 1 min 20 s
///
/// The ETA takes the speed of the part so far. Cheap enough to be told of every step.
class Progress {
  public:
    /// Wall time in s from any origin; a test has its own.
    using Clock = std::function<double()>;

    explicit Progress(ProgressStyle style);
    Progress(ProgressStyle style, std::FILE* out, int width, Clock clock);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void update(const ProgressState& state);

    /// Takes the bar off the screen, so that other text can be written; the next update draws it
    /// anew.
    void clear();

  private:
    /// What cannot be written is lost, see print_to_stderr.
    void write(const std::string& text);
    [[nodiscard]] bool is_due(const ProgressState& state, double now_s);
    [[nodiscard]] std::string line_text(const ProgressState& state, double now_s) const;

    ProgressStyle style_;
    std::FILE* out_;
    int width_;  // columns of the terminal; a longer bar would scroll
    Clock clock_;
    std::string part_;
    double part_begin_s_ = 0.0;
    double shown_s_ = 0.0;
    int shown_step_ = 0;  // the last 5 % that had its line
    bool drawn_ = false;
};

}  // namespace spheroscope::cli
