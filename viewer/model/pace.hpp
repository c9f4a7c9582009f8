#pragma once

#include <deque>
#include <utility>

namespace spheroscope::viewer {

/// How much model time goes by in a second of wall time, while the engine is not in a pause.
class Pace {
  public:
    /// A state of the engine at this model time was seen at this wall time.
    void see(double model_s, double wall_s);
    /// What comes next is no continuation: after a pause.
    void interrupt() { recent_.clear(); }

    /// Over the last two seconds or so; NaN before there are two states.
    [[nodiscard]] double recent() const;
    /// Over all that was seen; NaN before there are two states.
    [[nodiscard]] double overall() const;

  private:
    std::deque<std::pair<double, double>> recent_;  // model time, wall time
    double model_s_ = 0.0, wall_s_ = 0.0;           // summed over all intervals
};

}  // namespace spheroscope::viewer
