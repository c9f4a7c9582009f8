#pragma once

#include <array>
#include <atomic>
#include <csignal>

namespace spheroscope::cli {

/// While it lives, SIGINT and SIGTERM ask the work to stop instead of ending the program; a second
/// signal, the same or the other, ends it at once. One at a time.
class InterruptGuard {
  public:
    InterruptGuard();
    /// What the signals did before is put back.
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

    [[nodiscard]] const std::atomic<bool>& stop() const;

  private:
    std::array<struct sigaction, 2> before_{};
};

/// The signal that came last, 0 if none.
[[nodiscard]] int interrupt_signal();

}  // namespace spheroscope::cli
