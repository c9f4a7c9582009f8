#pragma once

#include <stdexcept>
#include <string>

namespace spheroscope {

/// Exit codes of the program, the same for every verb (README, 'Exit codes').
enum class ExitCode : int {
    ok = 0,
    internal = 1,
    usage = 2,          ///< wrong command line or scene
    not_converged = 3,  ///< unstable, or the end condition was not met
    differs = 4,        ///< something is not as expected: `diff`, [expect], `stability`
    environment = 5,    ///< no GL, no display, no ffmpeg
    hung_up = 129,      ///< SIGHUP, after a checkpoint
    interrupted = 130,  ///< SIGINT, after a checkpoint
    terminated = 143,   ///< SIGTERM, after a checkpoint
};

/// A place in a scene file. `line` 0 means: the whole file; empty `file`: no place (command line,
/// program).
struct Loc {
    std::string file;
    int line = 0;
    int column = 0;

    /// "scenes/a.toml:14:7", "scenes/a.toml" or "".
    [[nodiscard]] std::string text() const;
};

/// A user's mistake, or trouble with the surroundings: one message that says what was wanted, what
/// was got, and a hint. what() is the complete text, ready for stderr.
class Error : public std::runtime_error {
  public:
    Error(const Loc& loc, const std::string& message, const std::string& hint = "",
          ExitCode code = ExitCode::usage);
    explicit Error(const std::string& message, const std::string& hint = "",
                   ExitCode code = ExitCode::usage);

    [[nodiscard]] ExitCode code() const { return code_; }
    [[nodiscard]] const Loc& loc() const { return loc_; }

  private:
    Loc loc_;
    ExitCode code_;
};

namespace detail {
[[noreturn]] void assertion_failed(const char* condition, const char* file, int line,
                                   const std::string& detail);
}

}  // namespace spheroscope

/// Our own mistakes, never a user's input. On in Debug and wherever SPHEROSCOPE_CHECKS is defined.
#if !defined(NDEBUG) || defined(SPHEROSCOPE_CHECKS)
#define SPHEROSCOPE_ASSERT(condition, text)                                                        \
    do {                                                                                           \
        if (!(condition))                                                                          \
            ::spheroscope::detail::assertion_failed(#condition, __FILE__, __LINE__, (text));       \
    } while (false)
#else
#define SPHEROSCOPE_ASSERT(condition, text) static_cast<void>(0)
#endif
