#pragma once

#include "engine/measures/totals.hpp"
#include "engine/run/error_estimate.hpp"
#include "engine/solve/work.hpp"

#include <nlohmann/json_fwd.hpp>

#include <span>
#include <string>

namespace spheroscope::cli {

/// One line per row of the table of totals: name, value, unit; 'undefined' where it is, and 'not
/// resolved' in place of a number whose error is larger.
[[nodiscard]] std::string totals_text(const Totals& totals,
                                      std::span<const MeasureError> errors = {});
/// null where undefined.
[[nodiscard]] nlohmann::json totals_json(const Totals& totals);
/// Names of the rows that totals_text shows as not resolved; totals_json keeps their values.
[[nodiscard]] nlohmann::json not_resolved_json(std::span<const MeasureError> errors);
[[nodiscard]] nlohmann::json work_json(const Work& work);

}  // namespace spheroscope::cli
