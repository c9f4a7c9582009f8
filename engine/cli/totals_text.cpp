#include "engine/cli/totals_text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace spheroscope::cli {

std::string totals_text(const Totals& totals, std::span<const MeasureError> errors) {
    std::string text;
    for (const TotalsRow& row : all_totals()) {
        const double value = value_of(row, totals);
        std::string shown = "undefined";
        if (!is_resolved(row, errors))
            shown = "not resolved";
        else if (!std::isnan(value))
            shown =
                fmt::format("{:.5g}{}", value, row.unit == "1" ? "" : " " + std::string(row.unit));
        text += fmt::format("{:<20} {}\n", row.name, shown);
    }
    return text;
}

nlohmann::json totals_json(const Totals& totals) {
    nlohmann::json object = nlohmann::json::object();
    for (const TotalsRow& row : all_totals()) {
        const double value = value_of(row, totals);
        object[std::string(row.name)] =
            std::isfinite(value) ? nlohmann::json(value) : nlohmann::json();
    }
    return object;
}

nlohmann::json not_resolved_json(std::span<const MeasureError> errors) {
    nlohmann::json names = nlohmann::json::array();
    for (const TotalsRow& row : all_totals())
        if (!is_resolved(row, errors)) names.push_back(row.name);
    return names;
}

nlohmann::json work_json(const Work& work) {
    nlohmann::json terms = nlohmann::json::object();
    for (const Work::TermCount& count : work.terms) terms[count.term] = count.evaluations;
    nlohmann::json fields = nlohmann::json::object();
    for (const Work::TermCount& count : work.fields) fields[count.term] = count.evaluations;
    return {{"terms", terms},
            {"fields", fields},
            {"steps", work.steps},
            {"rejected_steps", work.rejected_steps},
            {"force_evaluations", work.force_evaluations},
            {"stiffness_evaluations", work.stiffness_evaluations},
            {"contact_searches", work.contact_searches},
            {"contact_candidates", work.contact_candidates},
            {"contact_pairs", work.contact_pairs},
            {"contact_too_deep", work.contact_too_deep},
            {"linear_solves", work.linear_solves},
            {"linear_iterations", work.linear_iterations},
            {"factorisations", work.factorisations},
            {"direct_solves", work.direct_solves}};
}

}  // namespace spheroscope::cli
