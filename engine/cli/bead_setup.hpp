#pragma once

#include "engine/claims/verdict.hpp"

#include <string>
#include <vector>

namespace spheroscope::cli {

/// A setup of beads alone (engine/stages/jamming): packing fraction and contacts at the jamming
/// point, and the exponent of the contacts above it, for these seeds. What was found is kept in
/// folder/<setup>/seed=<n>/jamming.json, and not made again.
[[nodiscard]] claims::MeasuredSetup measure_beads(const claims::ClaimedSetup& setup,
                                                  const std::string& folder,
                                                  const std::vector<std::uint64_t>& seeds,
                                                  bool makes_runs, const std::string& version);

}  // namespace spheroscope::cli
