#include "engine/claims/kept_report.hpp"

#include "engine/base/error.hpp"
#include "engine/base/fnv1a.hpp"
#include "engine/reports/csv_table.hpp"
#include "engine/statistics/derived_numbers.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace spheroscope::claims {
namespace {

using reports::CsvTable;
using statistics::SetupNumber;

constexpr reports::Missing k_none{"-"};

/// "1.5 - 2.25": one value for each run.
std::string list_text(const std::vector<double>& values) {
    std::string text;
    for (const double value : values) {
        if (!text.empty()) text += ' ';
        text += std::isnan(value) ? std::string("-") : fmt::format("{}", value);
    }
    return text;
}

std::vector<double> list_of(const CsvTable& table, std::size_t row) {
    std::vector<double> values;
    const std::string& text = table.text(row, "by_seed");
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find(' ', at), text.size());
        values.emplace_back();
        if (!reports::read_number(text.substr(at, end - at), values.back()))
            table.refuse(row, "by_seed", "numbers");
        at = end + 1;
    }
    return values;
}

/// What reports without 'by_seed' still have seed by seed: the totals of runs.csv.
std::vector<double> totals_of_runs(const MeasuredSetup& setup, const std::string& name) {
    const TotalsRow* const row = find_total(name);
    std::vector<double> values;
    for (const MeasuredRun& run : setup.runs)
        if (row != nullptr && run.totals) values.push_back(run.total(*row));
    return values.size() == setup.runs.size() ? values : std::vector<double>{};
}

MeasuredRun run_of(const CsvTable& table, std::size_t row) {
    MeasuredRun run;
    run.seed = table.integer<std::uint64_t>(row, "seed");
    run.outcome = table.text(row, "outcome");
    run.version = table.text(row, "version");
    run.time_s = table.number(row, "time_s");
    run.wall_s = table.number(row, "wall_s");
    if (table.has("last_dt_s")) run.last_dt_s = table.number(row, "last_dt_s");
    // before there were marks, a report did not say of which version of the scene it was
    if (table.has("scene") && table.text(row, "scene") != "-") run.scene = table.text(row, "scene");
    Totals totals{};
    bool is_of_cells = false;
    for (const TotalsRow& total : all_totals()) {
        // a report of an older version has fewer of them
        const bool is_missing = !table.has(total.name) || table.is_missing(row, total.name);
        is_of_cells = is_of_cells || !is_missing;
        if (const auto* real = std::get_if<double Totals::*>(&total.member))
            totals.** real = is_missing ? std::numeric_limits<double>::quiet_NaN()
                                        : table.number(row, total.name);
        else if (is_missing)
            run.missing_counts.push_back(total.name);
        else
            totals.*std::get<int Totals::*>(total.member) = table.integer<int>(row, total.name);
    }
    if (is_of_cells) run.totals = totals;
    return run;
}

}  // namespace

reports::ReportTable numbers_report(const MeasuredSetups& measured) {
    reports::ReportTable table;
    table.columns = {{"setup"}, {"number"}, {"unit"},  {"mean"},  {"standard_error"},
                     {"seeds"}, {"law"},    {"cells"}, {"nodes"}, {"by_seed"}};
    for (const auto& [name, setup] : measured)
        for (const SetupNumber& number : setup.numbers)
            table.rows.push_back(
                {name, number.name, number.unit, number.estimate.mean,
                 number.estimate.standard_error, std::int64_t{number.estimate.n}, setup.law,
                 std::int64_t{setup.n_cells},
                 setup.n_nodes == 0 ? reports::TableCell{k_none} : std::int64_t{setup.n_nodes},
                 list_text(number.by_run)});
    return table;
}

std::string scene_mark(std::string_view resolved_toml) {
    Fnv1a hash;
    hash.add(resolved_toml);
    return fmt::format("{:016x}", hash.value());
}

MeasuredSetups kept_setups(const std::string& folder) {
    const CsvTable numbers(folder + "/numbers.csv"), runs(folder + "/runs.csv");
    MeasuredSetups kept;
    for (std::size_t row = 0; row < runs.n_rows(); ++row)
        kept[runs.text(row, "setup")].runs.push_back(run_of(runs, row));
    const bool has_values = numbers.has("by_seed");
    for (std::size_t row = 0; row < numbers.n_rows(); ++row) {
        MeasuredSetup& setup = kept[numbers.text(row, "setup")];
        setup.law = numbers.text(row, "law");
        setup.n_cells = numbers.integer<int>(row, "cells");
        setup.n_nodes = numbers.is_missing(row, "nodes") ? 0 : numbers.integer<int>(row, "nodes");
        SetupNumber number{numbers.text(row, "number"),
                           numbers.text(row, "unit"),
                           {numbers.number(row, "mean"), numbers.number(row, "standard_error"),
                            numbers.integer<int>(row, "seeds")}};
        if (has_values)
            number.by_run = list_of(numbers, row);
        else
            number.by_run = totals_of_runs(setup, number.name);
        setup.numbers.push_back(std::move(number));
    }
    for (auto& [name, setup] : kept) {
        setup.is_kept = true;
        statistics::add_derived_numbers(setup.numbers, setup.law);
        for (const std::string& comment : runs.comments())
            if (comment.starts_with(name + ", "))
                setup.remarks.push_back(comment.substr(name.size() + 2));
    }
    return kept;
}

}  // namespace spheroscope::claims
