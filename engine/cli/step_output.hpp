#pragma once

#include "engine/run/step_anatomy.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace spheroscope::cli {

/// A step taken apart, as tables: terms with the sums before and after them, residuals of the
/// solves.
[[nodiscard]] std::string step_text(const StepAnatomy& anatomy);
[[nodiscard]] nlohmann::json step_json(const StepAnatomy& anatomy);

}  // namespace spheroscope::cli
