#include "engine/cli/json_output.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace spheroscope::cli {

void print_json(const nlohmann::json& document) {
    constexpr int indent = 2;
    fmt::print("{}\n", document.dump(indent, ' ', false, nlohmann::json::error_handler_t::replace));
}

}  // namespace spheroscope::cli
