#pragma once

#include "engine/measures/totals.hpp"

#include <nlohmann/json_fwd.hpp>

#include <span>
#include <string>

namespace spheroscope::cli {

/// One line per row of the table of totals: name, mean over seeds +- standard error, unit, and over
/// how many seeds if it is undefined in some.
[[nodiscard]] std::string seed_means_text(std::span<const Totals> seeds);
/// {name: {mean, standard_error, seeds}}; null where undefined.
[[nodiscard]] nlohmann::json seed_means_json(std::span<const Totals> seeds);

/// "0.7514 +- 0.0021"; the error has two digits, the mean as many places; 'undefined' where there
/// is no mean, no error where there is none.
[[nodiscard]] std::string with_error(double mean, double standard_error);

}  // namespace spheroscope::cli
