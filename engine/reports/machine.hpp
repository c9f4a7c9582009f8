#pragma once

#include <string>

namespace spheroscope::reports {

/// What timings depend on besides the program; a part of every report that has timings.
struct Machine {
    std::string processor;  ///< as the system names it
    int cores = 0;          ///< that this process may use
};
[[nodiscard]] Machine this_machine();

/// CPU time of all threads of this process so far, s. Unlike wall time it does not count what other
/// processes do.
[[nodiscard]] double cpu_clock_s();

/// Wall time from any origin, s.
[[nodiscard]] double wall_clock_s();

/// Memory that this process has asked for and not given back, MB. Unlike resident memory it does
/// not count what earlier work has left behind.
[[nodiscard]] double allocated_MB();

}  // namespace spheroscope::reports
