#pragma once

namespace spheroscope {

/// Whether the members of a pool work together or its caller works alone, on a machine that others
/// use as well: a team waits at each barrier for the one of its members that has no core just now,
/// and is then slower than a single thread (engine/README.md has the numbers).
///
/// It compares what the members get: the CPU time of all that work over the time that passes. A
/// quiet machine gives a team of two 1.8, one thread 1.0; a busy one gives the team 0.6. While the
/// caller works alone the team is tried again, after pauses that double up to half a minute.
class TeamChoice {
  public:
    /// A window of time has to be this long, so that a decision is not that of one slice of the
    /// scheduler.
    static constexpr double k_window_s = 0.1;
    /// CPU time of a team that is lost by waiting and sharing caches, as a factor.
    static constexpr double k_cost_of_team = 1.2;
    static constexpr double k_shortest_pause_s = 1.0, k_longest_pause_s = 32.0;

    /// Whether the members work together now. They begin with that.
    [[nodiscard]] bool is_together() const { return is_together_; }
    /// Work was done for wall_s. cpu_s: what those got who worked, in the whole window.
    void window(double wall_s, double cpu_s);

  private:
    bool is_together_ = true;
    /// CPU time over time, of the caller alone: as last seen, and on its way back to 1 while the
    /// team works, because others may have gone since.
    double alone_ = 1.0;
    double pause_s_ = k_shortest_pause_s;
    double waited_s_ = 0.0;  ///< alone, since the team was given up
};

}  // namespace spheroscope
