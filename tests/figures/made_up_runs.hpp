#pragma once

#include "engine/statistics/run_statistics.hpp"

namespace spheroscope::test {

/// A run with made-up numbers: sigma_h rises as r - 0.6 (kPa), Z = 12 and every cell touches, plus
/// a small step for each seed; no force is exponential by chance.
[[nodiscard]] statistics::RunStatistics made_up_run(double gamma_over_omega, double Et_over_omega,
                                                    std::uint64_t seed);

}  // namespace spheroscope::test
