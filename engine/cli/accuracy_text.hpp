#pragma once

#include "engine/run/error_estimate.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace spheroscope::cli {

/// A line per measure, "contact_area 6.36e4 +- 12 um^2 (time 3, rest 12)", or 'not resolved' where
/// the error exceeds the value; then what would halve the largest relative error. "" for none.
[[nodiscard]] std::string accuracy_text(const std::vector<MeasureError>& errors);
[[nodiscard]] nlohmann::json accuracy_json(const std::vector<MeasureError>& errors);

}  // namespace spheroscope::cli
