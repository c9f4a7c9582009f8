#pragma once

#include <nlohmann/json_fwd.hpp>

namespace spheroscope::cli {

/// Writes the one JSON document of a run with --json to stdout. Bytes that are not UTF-8 (they can
/// come out of a user's file) are replaced, because JSON has no place for them.
void print_json(const nlohmann::json& document);

}  // namespace spheroscope::cli
