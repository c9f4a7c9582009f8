#include "engine/cli/seed_means_text.hpp"

#include "engine/base/counted.hpp"
#include "engine/cli/report_output.hpp"
#include "engine/statistics/seed_mean.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace spheroscope::cli {
namespace {

statistics::Estimate estimate_of(const TotalsRow& row, std::span<const Totals> seeds) {
    std::vector<double> values;
    for (const Totals& totals : seeds) values.push_back(value_of(row, totals));
    return statistics::mean_over_seeds(values);
}

}  // namespace

std::string seed_means_text(std::span<const Totals> seeds) {
    std::string text;
    for (const TotalsRow& row : all_totals()) {
        const statistics::Estimate estimate = estimate_of(row, seeds);
        const std::string unit =
            row.unit == "1" || estimate.n == 0 ? "" : " " + std::string(row.unit);
        const std::string some =
            estimate.n > 0 && estimate.n < static_cast<int>(seeds.size())
                ? fmt::format(" ({} of {})", estimate.n, counted(seeds.size(), "seed"))
                : "";
        text += fmt::format("{:<20} {}{}{}\n", row.name,
                            with_error(estimate.mean, estimate.standard_error), unit, some);
    }
    return text;
}

nlohmann::json seed_means_json(std::span<const Totals> seeds) {
    nlohmann::json object = nlohmann::json::object();
    for (const TotalsRow& row : all_totals()) {
        const statistics::Estimate estimate = estimate_of(row, seeds);
        object[std::string(row.name)] = {
            {"mean", number_or_null(estimate.mean)},
            {"standard_error", number_or_null(estimate.standard_error)},
            {"seeds", estimate.n}};
    }
    return object;
}

std::vector<std::string> remarks_on_resolution(std::span<const std::uint64_t> seeds,
                                               std::span<const std::vector<MeasureError>> errors) {
    std::vector<std::string> remarks;
    for (const TotalsRow& row : all_totals()) {
        std::vector<std::uint64_t> unresolved;
        for (std::size_t i = 0; i < seeds.size(); ++i)
            if (!is_resolved(row, errors[i])) unresolved.push_back(seeds[i]);
        if (!unresolved.empty())
            remarks.push_back(fmt::format(
                "{} is not resolved in seed {}: its error there is larger than its value", row.name,
                fmt::join(unresolved, ", ")));
    }
    return remarks;
}

std::string with_error(double mean, double standard_error) {
    if (std::isnan(mean)) return "undefined";
    if (std::isnan(standard_error)) return fmt::format("{:.5g}", mean);
    if (standard_error == 0.0) return fmt::format("{:.5g} +- 0", mean);
    const int places = 1 - static_cast<int>(std::floor(std::log10(standard_error)));
    if (places > 8 || std::abs(mean) >= 1e6)
        return fmt::format("{:.5g} +- {:.2g}", mean, standard_error);
    return fmt::format("{:.{}f} +- {:.2g}", mean, std::max(0, places), standard_error);
}

}  // namespace spheroscope::cli
