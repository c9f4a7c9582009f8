#include "engine/cli/accuracy_text.hpp"

#include "engine/cli/report_output.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace spheroscope::cli {

std::string accuracy_text(const std::vector<MeasureError>& errors) {
    if (errors.empty()) return "";
    std::string text = "estimated errors of the end:\n";
    const MeasureError* worst = nullptr;
    for (const MeasureError& error : errors) {
        const double total = error.total();
        std::string parts;
        const auto add = [&](std::string_view name, double part) {
            if (!std::isnan(part))
                parts += fmt::format("{}{}{:.2g}", parts.empty() ? "" : ", ", name, part);
        };
        add(error.time_is_measured ? "time " : "time ~", error.time);
        add("rest ", error.rest);
        add("mesh ", error.mesh);
        const std::string unit = error.unit == "1" ? "" : " " + error.unit;
        if (std::isnan(total)) {
            text += fmt::format("  {:<18} {:.5g}{}, error not known\n", error.measure, error.value,
                                unit);
            continue;
        }
        text += error.is_resolved() ? fmt::format("  {:<18} {:.5g} +- {:.2g}{} ({})\n",
                                                  error.measure, error.value, total, unit, parts)
                                    : fmt::format("  {:<18} not resolved: error {:.2g}{} ({})\n",
                                                  error.measure, total, unit, parts);
        const auto relative = [](const MeasureError& e) { return e.total() / std::abs(e.value); };
        if (worst == nullptr || relative(error) > relative(*worst)) worst = &error;
    }
    const bool is_rough = std::any_of(errors.begin(), errors.end(), [](const MeasureError& e) {
        return !std::isnan(e.time) && !e.time_is_measured;
    });
    if (is_rough)
        text += "  ~: a guess from the last step alone, often ten times too small; "
                "measures.time_error = true measures it\n";
    if (worst != nullptr)
        text += fmt::format("  largest: {}; {}\n", worst->measure, worst->advice());
    return text;
}

nlohmann::json accuracy_json(const std::vector<MeasureError>& errors) {
    nlohmann::json list = nlohmann::json::array();
    for (const MeasureError& error : errors)
        list.push_back({{"measure", error.measure},
                        {"unit", error.unit},
                        {"value", number_or_null(error.value)},
                        {"error", number_or_null(error.total())},
                        {"time", number_or_null(error.time)},
                        {"time_is_measured", error.time_is_measured},
                        {"rest", number_or_null(error.rest)},
                        {"mesh", number_or_null(error.mesh)},
                        {"resolved", error.is_resolved()},
                        {"advice", error.advice()}});
    return list;
}

}  // namespace spheroscope::cli
