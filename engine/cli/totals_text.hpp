#pragma once

#include "engine/measures/totals.hpp"
#include "engine/solve/work.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace spheroscope::cli {

/// One line per row of the table of totals: name, value, unit; 'undefined' where it is.
[[nodiscard]] std::string totals_text(const Totals& totals);
/// null where undefined.
[[nodiscard]] nlohmann::json totals_json(const Totals& totals);
[[nodiscard]] nlohmann::json work_json(const Work& work);

}  // namespace spheroscope::cli
