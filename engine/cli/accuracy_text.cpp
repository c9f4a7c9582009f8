#include "engine/cli/accuracy_text.hpp"

#include "engine/cli/progress.hpp"
#include "engine/cli/report_output.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace spheroscope::cli {
namespace {

/// Wall times of the other runs over that of the run: half the steps take two; the coarser meshes
/// have a quarter of the nodes, and a sixteenth.
constexpr double k_time_error_costs = 2.0, k_mesh_error_costs = 0.25;

/// "126.96 +- 19 um^2 (time 0.032, mesh 19); may still change by 12", with what is known.
std::string line_of(const MeasureError& error) {
    const std::string unit = error.unit == "1" ? "" : " " + error.unit;
    std::string parts;
    const auto add = [&](std::string_view name, double part) {
        if (!std::isnan(part))
            parts += fmt::format("{}{} {:.2g}", parts.empty() ? "" : ", ", name, part);
    };
    add("time", error.time);
    add("mesh", error.mesh);
    const double measured = error.measured();
    std::string text;
    if (!error.is_resolved())
        text = "not resolved" +
               (parts.empty() ? "" : fmt::format(": error {:.2g}{} ({})", measured, unit, parts));
    else if (parts.empty())
        text = fmt::format("{:.5g}{}", error.value, unit);
    else
        text = fmt::format("{:.5g} +- {:.2g}{} ({})", error.value, measured, unit, parts);
    if (!std::isnan(error.rest)) text += fmt::format("; may still change by {:.2g}", error.rest);
    return text;
}

/// Which second runs were not made, and what they would take.
std::string missing_text(const std::vector<MeasureError>& errors, double wall_s) {
    const bool has_time_steps =
        std::any_of(errors.begin(), errors.end(),
                    [](const MeasureError& error) { return !error.halves_time.empty(); });
    const auto none_has = [&](double MeasureError::*part) {
        return std::all_of(errors.begin(), errors.end(),
                           [&](const MeasureError& error) { return std::isnan(error.*part); });
    };
    std::string text;
    const auto add = [&](std::string_view name, std::string_view runs, double costs) {
        const double takes_s = costs * wall_s;
        text += fmt::format(
            "  {0} error not measured: measures.{0}_error = true measures it, with "
            "{1} ({2})\n",
            name, runs, takes_s < 1.0 ? "less than a second" : "about " + duration_text(takes_s));
    };
    if (has_time_steps && none_has(&MeasureError::time))
        add("time", "a run of steps half as long", k_time_error_costs);
    if (none_has(&MeasureError::mesh)) add("mesh", "runs on coarser meshes", k_mesh_error_costs);
    return text;
}

}  // namespace

std::string accuracy_text(const std::vector<MeasureError>& errors, double wall_s) {
    if (errors.empty()) return "";
    std::string text = "estimated errors of the end:\n";
    const MeasureError* worst = nullptr;
    const auto relative = [](const MeasureError& e) {
        return std::hypot(std::isnan(e.measured()) ? 0.0 : e.measured(),
                          std::isnan(e.rest) ? 0.0 : e.rest) /
               std::abs(e.value);
    };
    for (const MeasureError& error : errors) {
        if (std::isnan(error.measured()) && std::isnan(error.rest)) continue;
        text += fmt::format("  {:<22} {}\n", error.measure, line_of(error));
        if (worst == nullptr || relative(error) > relative(*worst)) worst = &error;
    }
    if (worst != nullptr)
        text += fmt::format("  largest: {}; {}\n", worst->measure, worst->advice());
    return text + missing_text(errors, wall_s);
}

nlohmann::json accuracy_json(const std::vector<MeasureError>& errors) {
    nlohmann::json list = nlohmann::json::array();
    for (const MeasureError& error : errors)
        list.push_back({{"measure", error.measure},
                        {"unit", error.unit},
                        {"value", number_or_null(error.value)},
                        {"error", number_or_null(error.measured())},
                        {"time", number_or_null(error.time)},
                        {"mesh", number_or_null(error.mesh)},
                        {"rest", number_or_null(error.rest)},
                        {"resolved", error.is_resolved()},
                        {"advice", error.advice()}});
    return list;
}

}  // namespace spheroscope::cli
