#include "engine/claims/verdict.hpp"

#include "engine/base/counted.hpp"
#include "engine/statistics/motion_at_end.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

namespace spheroscope::claims {
namespace {

using statistics::Estimate;
using statistics::SetupNumber;

/// Thrown while one claim is evaluated: there is nothing to judge.
struct NoData {
    std::string reason;
};

const SetupNumber& find_number(const Quantity& quantity, const MeasuredSetups& measured) {
    const auto at = measured.find(quantity.setup);
    if (at == measured.end()) throw NoData{quantity.setup + " was not run"};
    const MeasuredSetup& setup = at->second;
    if (setup.runs.empty())
        throw NoData{fmt::format("{}: {}", quantity.setup,
                                 setup.troubles.empty() ? "no run" : setup.troubles.front())};
    const auto number =
        std::find_if(setup.numbers.begin(), setup.numbers.end(),
                     [&](const SetupNumber& n) { return n.name == quantity.number; });
    if (number == setup.numbers.end() && setup.is_kept)
        throw NoData{fmt::format("the report that {} is kept from does not have '{}'",
                                 quantity.setup, quantity.number)};
    if (number == setup.numbers.end()) {
        std::vector<std::string> names;
        for (const SetupNumber& n : setup.numbers) names.push_back(n.name);
        throw Error(quantity.loc, fmt::format("there is no number '{}'", quantity.number),
                    "numbers are " + fmt::format("{}", fmt::join(names, ", ")));
    }
    return *number;
}

/// The values of two numbers in the runs of the same seed. Seeds are comparable where the setups
/// have as many cells: then the same seed has packed them in the same way.
struct PairedValues {
    std::vector<double> a, b;
};

PairedValues paired(const SetupNumber& a, const MeasuredSetup& of_a, const SetupNumber& b,
                    const MeasuredSetup& of_b) {
    PairedValues pairs;
    if (of_a.n_cells != of_b.n_cells || a.by_run.size() != of_a.runs.size() ||
        b.by_run.size() != of_b.runs.size())
        return pairs;
    for (std::size_t i = 0; i < of_a.runs.size(); ++i)
        for (std::size_t j = 0; j < of_b.runs.size(); ++j)
            if (of_a.runs[i].seed == of_b.runs[j].seed) {
                pairs.a.push_back(a.by_run[i]);
                pairs.b.push_back(b.by_run[j]);
            }
    return pairs;
}

/// Mean and error of a - b or a / b: seed by seed where both have the same ones, so that what a
/// seed does to both does not count as an error; else of the two means.
Estimate combined(const SetupNumber& a, const SetupNumber& b, const PairedValues& pairs,
                  bool is_ratio) {
    if (!pairs.a.empty()) {
        std::vector<double> values;
        for (std::size_t i = 0; i < pairs.a.size(); ++i)
            values.push_back(is_ratio ? pairs.a[i] / pairs.b[i] : pairs.a[i] - pairs.b[i]);
        return statistics::mean_over_seeds(values);
    }
    const Estimate &x = a.estimate, &y = b.estimate;
    Estimate result;
    result.n = std::min(x.n, y.n);
    if (is_ratio) {
        result.mean = x.mean / y.mean;
        result.standard_error =
            std::hypot(x.standard_error, result.mean * y.standard_error) / std::abs(y.mean);
    } else {
        result.mean = x.mean - y.mean;
        result.standard_error = std::hypot(x.standard_error, y.standard_error);
    }
    return result;
}

Estimate value_of(const Claim& claim, const MeasuredSetups& measured) {
    const SetupNumber& number = find_number(claim.measured, measured);
    Estimate value = number.estimate;
    if (const auto& other = claim.minus ? claim.minus : claim.over) {
        const SetupNumber& compared = find_number(*other, measured);
        const PairedValues pairs =
            paired(number, measured.at(claim.measured.setup), compared, measured.at(other->setup));
        value = combined(number, compared, pairs, claim.over.has_value());
    }
    value.mean *= claim.factor;
    value.standard_error *= std::abs(claim.factor);
    if (!std::isfinite(value.mean))
        throw NoData{fmt::format("'{}' is undefined in these runs", claim.measured.number)};
    return value;
}

/// "case_b" or "case_b - case_a"
std::string setups_text(const Claim& claim) {
    const auto& other = claim.minus ? claim.minus : claim.over;
    if (!other || other->setup == claim.measured.setup) return claim.measured.setup;
    return fmt::format("{} {} {}", claim.measured.setup, claim.minus ? "-" : "/", other->setup);
}

std::string number_text(const Claim& claim) {
    const auto& other = claim.minus ? claim.minus : claim.over;
    if (!other || other->number == claim.measured.number) return claim.measured.number;
    return fmt::format("{} {} {}", claim.measured.number, claim.minus ? "-" : "/", other->number);
}

std::string with_unit(const std::string& text, const std::string& unit) {
    return unit.empty() ? text : text + " " + unit;
}

std::string value_text(const Estimate& value) {
    if (std::isnan(value.mean)) return "-";
    if (std::isnan(value.standard_error)) return fmt::format("{:.4g}", value.mean);
    return fmt::format("{:.4g} +- {:.2g}", value.mean, value.standard_error);
}

const MeasuredSetup* setup_of(const JudgedClaim& judged, const MeasuredSetups& measured) {
    const auto at = measured.find(judged.claim->measured.setup);
    return at == measured.end() ? nullptr : &at->second;
}

/// Whether a one-sided claim is met by so little that it might be missed.
bool is_by_less_than_its_error(const Claim& claim, const Estimate& value) {
    if (!claim.paper.is_one_sided() || std::isnan(value.standard_error)) return false;
    const double margin =
        std::min(std::abs(value.mean - claim.paper.min), std::abs(value.mean - claim.paper.max));
    return margin < 2.0 * value.standard_error;
}

/// "150 x 642, traction"; "1000 beads"
std::string size_text(const MeasuredSetup& setup) {
    return setup.n_nodes == 0 ? counted(setup.n_cells, "bead")
                              : fmt::format("{} x {}, {}", setup.n_cells, setup.n_nodes, setup.law);
}

/// "1"; "0.25 ... 1"; "unknown" where no run says.
std::string steps_text(const MeasuredSetup& setup) {
    double shortest = std::numeric_limits<double>::infinity(), longest = -shortest;
    for (const MeasuredRun& run : setup.runs) {
        shortest = std::fmin(shortest, run.last_dt_s);
        longest = std::fmax(longest, run.last_dt_s);
    }
    if (shortest > longest) return "unknown";
    const std::string from = fmt::format("{:.3g}", shortest), to = fmt::format("{:.3g}", longest);
    return (from == to ? to : from + " ... " + to) + " s";
}

}  // namespace

std::string ends_text(const MeasuredSetup& setup) {
    static const TotalsRow& flipped = *find_total("n_flipped_triangles");
    std::size_t n_at_rest = 0, n_runs = 0;
    double n_flipped = 0.0;  // NaN: of some run it is not known
    for (const MeasuredRun& run : setup.runs) {
        if (!run.totals) continue;
        ++n_runs;
        n_flipped += run.total(flipped);
        if (run.outcome == "rest" &&
            !statistics::is_faster_than_rest(run.totals->normal_speed_rms_um_per_s))
            ++n_at_rest;
    }
    if (n_runs == 0) return "";
    return fmt::format("rest {} of {}, flips {}, last dt {}", n_at_rest, n_runs,
                       std::isnan(n_flipped) ? "unknown" : fmt::format("{:.0f}", n_flipped),
                       steps_text(setup));
}

std::string ends_text(const Claim& claim, const MeasuredSetups& measured) {
    const std::vector<std::string> names = claim.setups();
    std::string text;
    for (const std::string& name : names) {
        const auto setup = measured.find(name);
        const std::string ends = setup == measured.end() ? "" : ends_text(setup->second);
        if (ends.empty()) continue;
        text += (text.empty() ? "" : "; ") + (names.size() > 1 ? name + ": " : "") + ends;
    }
    return text;
}

std::string remark_on_motion(const MeasuredSetup& setup) {
    std::vector<statistics::MotionAtEnd> ends;
    for (const MeasuredRun& run : setup.runs)
        if (run.totals)
            ends.push_back({run.seed, run.outcome, run.totals->normal_speed_rms_um_per_s});
    return statistics::remark_on_motion(ends);
}

std::string_view name_of(Verdict verdict) {
    switch (verdict) {
    case Verdict::agrees: return "agrees";
    case Verdict::differs: return "differs";
    case Verdict::not_decidable: return "not decidable";
    case Verdict::no_data: return "no data";
    }
    return "";
}

Verdict judge(const Claim& claim, const Estimate& value) {
    if (!std::isfinite(value.mean)) return Verdict::no_data;
    if (!claim.undecidable.empty()) return Verdict::not_decidable;
    const bool is_by_error = !claim.paper.is_one_sided() && !std::isnan(value.standard_error) &&
                             claim.paper.distance(value.mean) <= 2.0 * value.standard_error;
    return is_by_error || claim.accepted().distance(value.mean) == 0.0 ? Verdict::agrees
                                                                       : Verdict::differs;
}

std::string command_of(const Claim& claim) {
    std::string command = "spheroscope reproduce";
    // the paper's claims are what the program takes if it is given none
    if (std::filesystem::path(claim.loc.file).filename() != "paper.claims")
        command += " " + claim.loc.file;
    command += " --full";
    for (const std::string& setup : claim.setups()) command += " --only " + setup;
    return command;
}

std::vector<JudgedClaim> judge_claims(const ClaimTable& table, const MeasuredSetups& measured) {
    std::vector<JudgedClaim> judged;
    for (const Claim& claim : table.claims) {
        JudgedClaim row;
        row.claim = &claim;
        try {
            row.value = value_of(claim, measured);
            row.verdict = judge(claim, row.value);
            if (row.verdict == Verdict::not_decidable) row.reason = claim.undecidable;
            if (row.verdict == Verdict::agrees && claim.accepted().distance(row.value.mean) > 0.0)
                row.reason = "by its error alone, which is larger than the tolerance";
            if (row.verdict == Verdict::agrees && is_by_less_than_its_error(claim, row.value))
                row.reason = "by less than two standard errors";
        } catch (const NoData& none) {
            row.reason = none.reason;
        }
        judged.push_back(std::move(row));
    }
    return judged;
}

reports::ReportTable claims_report(const std::vector<JudgedClaim>& judged,
                                   const MeasuredSetups& measured) {
    reports::ReportTable table;
    table.columns = {{"claim"},          {"source", false}, {"says", false},    {"setup", false},
                     {"number"},         {"unit"},          {"paper"},          {"tolerance"},
                     {"written", false}, {"mean"},          {"standard_error"}, {"seeds"},
                     {"ends", false},    {"law", false},    {"cells", false},   {"nodes", false},
                     {"verdict"},        {"reason", false}, {"remark", false},  {"command", false}};
    constexpr reports::Missing none{"-"};
    for (const JudgedClaim& row : judged) {
        const Claim& claim = *row.claim;
        const MeasuredSetup* setup = setup_of(row, measured);
        table.rows.push_back(
            {claim.id,
             claim.source,
             claim.says,
             setups_text(claim),
             number_text(claim),
             claim.unit.empty() ? "1" : claim.unit,
             claim.paper.text(),
             claim.tolerance_text().empty() ? "0" : claim.tolerance_text(),
             std::string(name_of(claim.written)),
             row.value.mean,
             row.value.standard_error,
             std::int64_t{row.value.n},
             ends_text(claim, measured),
             setup == nullptr ? "" : setup->law,
             setup == nullptr ? reports::TableCell{none} : std::int64_t{setup->n_cells},
             setup == nullptr || setup->n_nodes == 0 ? reports::TableCell{none}
                                                     : std::int64_t{setup->n_nodes},
             std::string(name_of(row.verdict)),
             row.reason,
             claim.remark,
             command_of(claim)});
    }
    return table;
}

double MeasuredRun::total(const TotalsRow& row) const {
    const bool is_missing =
        std::find(missing_counts.begin(), missing_counts.end(), row.name) != missing_counts.end();
    return is_missing ? std::numeric_limits<double>::quiet_NaN() : value_of(row, totals.value());
}

reports::ReportTable runs_report(const MeasuredSetups& measured) {
    reports::ReportTable table;
    table.columns = {{"setup"},  {"seed"},      {"outcome"}, {"time_s"},
                     {"wall_s"}, {"last_dt_s"}, {"version"}, {"scene"}};
    for (const TotalsRow& row : all_totals()) table.columns.push_back({std::string(row.name)});
    for (const auto& [name, setup] : measured)
        for (const MeasuredRun& run : setup.runs) {
            std::vector<reports::TableCell> cells{name,        static_cast<std::int64_t>(run.seed),
                                                  run.outcome, run.time_s,
                                                  run.wall_s,  run.last_dt_s,
                                                  run.version};
            if (run.scene.empty())
                cells.emplace_back(reports::Missing{"-"});
            else
                cells.emplace_back(run.scene);
            for (const TotalsRow& row : all_totals())
                cells.emplace_back(run.totals ? run.total(row)
                                              : std::numeric_limits<double>::quiet_NaN());
            table.rows.push_back(std::move(cells));
        }
    return table;
}

std::string claims_markdown(const std::vector<JudgedClaim>& judged,
                            const MeasuredSetups& measured) {
    std::string text =
        "| claim | where | the paper says | number, setup | paper | tolerance | written before "
        "or after the runs | we measure | seeds | ends of the runs | mesh, law | verdict | runs "
        "and "
        "verdict again |\n"
        "|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
    for (const JudgedClaim& row : judged) {
        const Claim& claim = *row.claim;
        const MeasuredSetup* setup = setup_of(row, measured);
        std::string verdict = fmt::format("**{}**", name_of(row.verdict));
        if (!row.reason.empty()) verdict += ": " + row.reason;
        if (!claim.remark.empty()) verdict += fmt::format(" ({})", claim.remark);
        text += fmt::format(
            "| `{}` | {} | {} | {}, {} | {} | {} | {} | {} | {} | {} | {} | {} | `{}` |\n",
            claim.id, claim.source, claim.says, number_text(claim), setups_text(claim),
            with_unit(claim.paper.text(), claim.unit), claim.tolerance_text(),
            name_of(claim.written), with_unit(value_text(row.value), claim.unit), row.value.n,
            ends_text(claim, measured), setup == nullptr ? "-" : size_text(*setup), verdict,
            command_of(claim));
    }
    return text;
}

}  // namespace spheroscope::claims
