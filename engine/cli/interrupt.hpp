#pragma once

#include <atomic>
#include <csignal>

namespace spheroscope::cli {

/// While it lives, SIGINT and SIGTERM ask the run to stop instead of ending the program; a second signal
/// ends it at once. One at a time.
class InterruptGuard {
  public:
    InterruptGuard();
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

    [[nodiscard]] const std::atomic<bool>& stop() const;
};

/// The signal that came last, 0 if none.
[[nodiscard]] int interrupt_signal();

}  // namespace spheroscope::cli
