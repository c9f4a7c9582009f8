#include "engine/cli/interrupt.hpp"

namespace spheroscope::cli {
namespace {

// A signal handler can reach nothing but globals, and of these only lock-free atomics.
std::atomic<bool> asked_to_stop{false};
std::atomic<int> last_signal{0};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

extern "C" void ask_to_stop(int signal) {
    asked_to_stop.store(true);
    last_signal.store(signal);
    std::signal(signal, SIG_DFL);
}

}  // namespace

InterruptGuard::InterruptGuard() {
    asked_to_stop.store(false);
    last_signal.store(0);
    std::signal(SIGINT, ask_to_stop);
    std::signal(SIGTERM, ask_to_stop);
}

InterruptGuard::~InterruptGuard() {
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
}

const std::atomic<bool>& InterruptGuard::stop() const { return asked_to_stop; }

int interrupt_signal() { return last_signal.load(); }

}  // namespace spheroscope::cli
