#pragma once

#include "engine/measures/totals.hpp"
#include "engine/run/error_estimate.hpp"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace spheroscope::cli {

/// One line per row of the table of totals: name, mean over seeds +- standard error, unit, and over
/// how many seeds if it is undefined in some.
[[nodiscard]] std::string seed_means_text(std::span<const Totals> seeds);
/// {name: {mean, standard_error, seeds}}; null where undefined.
[[nodiscard]] nlohmann::json seed_means_json(std::span<const Totals> seeds);

/// Means do not show that a run's own error is larger than what it gives: a line for each measure
/// and the seeds in which it is so. errors: [seeds], as the runs estimate them.
[[nodiscard]] std::vector<std::string>
remarks_on_resolution(std::span<const std::uint64_t> seeds,
                      std::span<const std::vector<MeasureError>> errors);

/// "0.7514 +- 0.0021"; the error has two digits, the mean as many places; 'undefined' where there
/// is no mean, no error where there is none.
[[nodiscard]] std::string with_error(double mean, double standard_error);

}  // namespace spheroscope::cli
