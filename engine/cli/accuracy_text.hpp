#pragma once

#include "engine/run/error_estimate.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace spheroscope::cli {

/// A line per measure, "contact_area 6.36e4 +- 12 um^2 (time 3, mesh 11)": +- stands before
/// measured errors alone; beside it what may still come before rest, if the run was to come to it.
/// 'not resolved' where these exceed the value. Then what would halve the largest relative one, and
/// which errors were not measured, with what that takes; wall_s: of the run. "" for no errors.
[[nodiscard]] std::string accuracy_text(const std::vector<MeasureError>& errors, double wall_s);
[[nodiscard]] nlohmann::json accuracy_json(const std::vector<MeasureError>& errors);

}  // namespace spheroscope::cli
