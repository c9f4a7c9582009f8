#pragma once

#include "engine/claims/verdict.hpp"

#include <string>
#include <string_view>

namespace spheroscope::claims {

// A report can be gone on with where its runs are no longer: numbers.csv and runs.csv have
// everything that claims are judged by.

/// Every number of every setup, with its values seed by seed: numbers.csv.
[[nodiscard]] reports::ReportTable numbers_report(const MeasuredSetups& measured);

/// What tells one version of a scene from another: FNV-1a over the resolved scene, 16 digits.
[[nodiscard]] std::string scene_mark(std::string_view resolved_toml);

/// The setups of an earlier report in `folder`, with the remarks on their runs. Throws Error for
/// files that are missing or damaged.
[[nodiscard]] MeasuredSetups kept_setups(const std::string& folder);

}  // namespace spheroscope::claims
