#pragma once

#include "engine/base/error.hpp"

#include <array>
#include <atomic>
#include <csignal>

namespace spheroscope::cli {

/// While it lives, SIGINT, SIGTERM and SIGHUP ask the work to stop instead of ending the program; a
/// second signal, the same or another, ends it at once. A SIGHUP that is ignored when it begins, as
/// `nohup` has it, stays ignored. One at a time.
class InterruptGuard {
  public:
    InterruptGuard();
    /// What the signals did before is put back.
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

    [[nodiscard]] const std::atomic<bool>& stop() const;

  private:
    std::array<struct sigaction, 3> before_{};
};

/// The signal that came last, 0 if none.
[[nodiscard]] int interrupt_signal();
/// The exit code that belongs to it, or `code` if none came.
[[nodiscard]] ExitCode code_after_signal(ExitCode code);

}  // namespace spheroscope::cli
