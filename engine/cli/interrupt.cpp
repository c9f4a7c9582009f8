#include "engine/cli/interrupt.hpp"

namespace spheroscope::cli {
namespace {

constexpr std::array k_signals{SIGINT, SIGTERM, SIGHUP};

// A signal handler can reach nothing but globals, and of these only lock-free atomics.
std::atomic<bool> asked_to_stop{false};
std::atomic<int> last_signal{0};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

extern "C" void ask_to_stop(int signal) {
    // The signal first: whoever sees the request may ask at once which one it was.
    last_signal.store(signal);
    asked_to_stop.store(true);
    struct sigaction end_at_once {};
    end_at_once.sa_handler = SIG_DFL;
    for (const int each : k_signals) sigaction(each, &end_at_once, nullptr);
}

}  // namespace

InterruptGuard::InterruptGuard() {
    asked_to_stop.store(false);
    last_signal.store(0);
    struct sigaction ask {};
    ask.sa_handler = ask_to_stop;
    ask.sa_flags = SA_RESTART;  // a write in progress is finished, not broken off
    for (const int each : k_signals) sigaddset(&ask.sa_mask, each);  // one after the other
    for (std::size_t i = 0; i < k_signals.size(); ++i) {
        sigaction(k_signals[i], &ask, &before_[i]);
        if (k_signals[i] == SIGHUP && before_[i].sa_handler == SIG_IGN)
            sigaction(SIGHUP, &before_[i], nullptr);
    }
}

InterruptGuard::~InterruptGuard() {
    for (std::size_t i = 0; i < k_signals.size(); ++i)
        sigaction(k_signals[i], &before_[i], nullptr);
}

const std::atomic<bool>& InterruptGuard::stop() const { return asked_to_stop; }

int interrupt_signal() { return last_signal.load(); }

ExitCode code_after_signal(ExitCode code) {
    switch (interrupt_signal()) {
    case SIGHUP: return ExitCode::hung_up;
    case SIGINT: return ExitCode::interrupted;
    case SIGTERM: return ExitCode::terminated;
    default: return code;
    }
}

}  // namespace spheroscope::cli
