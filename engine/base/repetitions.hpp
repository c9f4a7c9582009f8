#pragma once

#include <atomic>
#include <chrono>

namespace spheroscope {

/// How often something is timed: the least of several repetitions counts, because other programs
/// only add. What takes long is repeated less often.
///
///     for (Repetitions::Count count(repetitions); count.goes_on();) ...
struct Repetitions {
    int most = 5;  ///< at least 1
    /// No new repetition after so much wall time; the first is always made.
    double longest_s = 2.0;
    const std::atomic<bool>* stop = nullptr;  ///< no new repetition once it is true

    class Count {
      public:
        explicit Count(const Repetitions& repetitions) : repetitions_(repetitions) {}
        /// Whether to begin another repetition; counts it.
        [[nodiscard]] bool goes_on() {
            using Clock = std::chrono::steady_clock;
            if (n_begun_ == 0) begin_ = Clock::now();
            const double passed_s = std::chrono::duration<double>(Clock::now() - begin_).count();
            const bool is_enough = n_begun_ >= repetitions_.most ||
                                   passed_s >= repetitions_.longest_s || repetitions_.is_stopped();
            if (n_begun_ > 0 && is_enough) return false;
            ++n_begun_;
            return true;
        }
        [[nodiscard]] int n_begun() const { return n_begun_; }

      private:
        const Repetitions& repetitions_;
        int n_begun_ = 0;
        std::chrono::steady_clock::time_point begin_{};
    };

    [[nodiscard]] bool is_stopped() const { return stop != nullptr && stop->load(); }
};

}  // namespace spheroscope
