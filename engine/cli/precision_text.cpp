#include "engine/cli/precision_text.hpp"

#include "engine/base/counted.hpp"
#include "engine/cli/report_output.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace spheroscope::cli {
namespace {

using reports::all_error_measures;
using reports::Missing;
using reports::TableCell;

TableCell error_cell(const reports::Precision& precision, const reports::PrecisionRow& row,
                     std::size_t measure) {
    if (!row.was_run) return Missing{"-"};
    if (!row.run.is_complete()) return Missing{"failed"};
    if (row.errors.empty()) return Missing{"no ref"};
    if (std::isnan(row.errors[measure])) return Missing{"-"};
    if (!precision.is_resolved(row, measure)) return Missing{"< ref"};
    return row.errors[measure];
}

/// It was run, and has no errors because it did not come to its end.
bool has_failed(const reports::PrecisionRow& row) {
    return row.was_run && row.run.verdict == RunVerdict::unstable && row.run.wall_s > 0.0;
}

nlohmann::json setting_json(const reports::MethodSetting& setting) {
    nlohmann::json object{{"text", setting.text()},
                          {"dt_s", setting.dt_s},
                          {"linear_tolerance", setting.linear_tolerance}};
    object["tolerance_um"] =
        setting.is_fixed() ? nlohmann::json() : nlohmann::json(setting.tolerance_um);
    return object;
}

nlohmann::json run_json(bool was_run, const reports::MeasuredRun& run) {
    const Work& work = run.work;
    return {{"outcome", outcome_word(was_run, run)},
            {"message", run.message},
            {"wall_s", was_run ? nlohmann::json(run.wall_s) : nlohmann::json()},
            {"cpu_s", was_run ? nlohmann::json(run.cpu_s) : nlohmann::json()},
            {"time_s", run.time_s},
            {"work",
             {{"steps", work.steps},
              {"rejected_steps", work.rejected_steps},
              {"force_evaluations", work.force_evaluations},
              {"stiffness_evaluations", work.stiffness_evaluations},
              {"pair_evaluations", work.contact_candidates},
              {"active_pairs", work.contact_pairs},
              {"linear_iterations", work.linear_iterations}}},
            {"hash", hash_text(run.state_hash)}};
}

/// What a mesh error is the difference to.
std::string reference_of(const reports::MeshResult& result) {
    return result.mesh_error_is_rough ? "finest level" : "limit";
}

/// How far above the largest error of a panel the runs without one stand: at its upper edge.
constexpr double k_above = 2.0;

/// Series of one measure, one for each method, in the order of the ladder; then, as crosses at the
/// upper edge, the runs of each that failed.
reports::Plot::Panel panel_of(const reports::Precision& precision, std::size_t measure) {
    reports::Plot::Panel panel;
    panel.title = all_error_measures()[measure].title;
    panel.x_title = "wall time (s)";
    panel.y_title = fmt::format("error ({})", all_error_measures()[measure].unit);
    double largest = 0.0;
    for (const reports::PrecisionRow& row : precision.rows) {
        const std::string name(row.setting.method->name);
        if (panel.series.empty() || panel.series.back().name != name)
            panel.series.push_back({name, {}, {}});
        const TableCell cell = error_cell(precision, row, measure);
        if (const double* error = std::get_if<double>(&cell); error != nullptr && *error > 0.0) {
            panel.series.back().x.push_back(row.run.wall_s);
            panel.series.back().y.push_back(*error);
            largest = std::max(largest, *error);
        }
    }
    if (largest == 0.0) return panel;
    for (const reports::PrecisionRow& row : precision.rows) {
        if (!has_failed(row)) continue;
        const std::string name(row.setting.method->name);
        if (panel.series.back().colour_of != name) {
            reports::Plot::Series crosses{.name = name + ", failed"};
            crosses.line = reports::Plot::Line::none;
            crosses.is_crossed_out = true;
            crosses.colour_of = name;
            panel.series.push_back(std::move(crosses));
        }
        panel.series.back().x.push_back(row.run.wall_s);
        panel.series.back().y.push_back(k_above * largest);
    }
    return panel;
}

/// Names the crosses, method by method: "crosses: forward_euler at dt = 15.4 ms, ... failed".
std::vector<std::string> caption_of(const reports::Precision& precision) {
    std::vector<std::string> lines;
    std::string_view last;
    for (const reports::PrecisionRow& row : precision.rows) {
        if (!has_failed(row)) continue;
        if (row.setting.method->name != last)
            lines.push_back(fmt::format("crosses at the upper edge failed: {}, {}",
                                        row.setting.method->name, row.setting.text()));
        else
            lines.back() += ", " + row.setting.text();
        last = row.setting.method->name;
    }
    return lines;
}

}  // namespace

std::string outcome_word(bool was_run, const reports::MeasuredRun& run) {
    if (!was_run) return "not run";
    switch (run.verdict) {
    case RunVerdict::finished:
    case RunVerdict::cap: return "finished";
    case RunVerdict::time_limit: return "time limit";
    case RunVerdict::stopped: return "stopped";
    case RunVerdict::unstable:
    case RunVerdict::sink_failed: return "failed";
    }
    return "";
}

reports::ReportTable table_of(const reports::Precision& precision) {
    reports::ReportTable table;
    table.columns = {{"method"}, {"setting"}};
    for (const reports::ErrorMeasure& measure : all_error_measures())
        table.columns.push_back({std::string(measure.name)});
    for (const char* name : {"wall_s", "cpu_s", "steps"}) table.columns.push_back({name});
    table.columns.push_back({"rejected", false});
    table.columns.push_back({"force_evaluations", false});
    table.columns.push_back({"pair_evaluations", false});
    table.columns.push_back({"active_pairs", false});
    table.columns.push_back({"iterations"});
    for (const char* name : {"dt_s", "tolerance_um", "linear_tolerance", "state_hash"})
        table.columns.push_back({name, false});
    table.columns.push_back({"outcome"});
    table.columns.push_back({"message", false});
    for (const reports::PrecisionRow& row : precision.rows) {
        const Work& work = row.run.work;
        std::vector<TableCell> cells{std::string(row.setting.method->name), row.setting.text()};
        for (std::size_t m = 0; m < all_error_measures().size(); ++m)
            cells.push_back(error_cell(precision, row, m));
        if (row.was_run) {
            for (const double value : {row.run.wall_s, row.run.cpu_s}) cells.emplace_back(value);
            for (const std::int64_t n :
                 {work.steps, work.rejected_steps, work.force_evaluations, work.contact_candidates,
                  work.contact_pairs, work.linear_iterations})
                cells.emplace_back(n);
        } else {
            cells.insert(cells.end(), 8, Missing{"-"});
        }
        cells.emplace_back(row.setting.dt_s);
        if (row.setting.is_fixed())
            cells.emplace_back(Missing{"-"});
        else
            cells.emplace_back(row.setting.tolerance_um);
        cells.emplace_back(row.setting.linear_tolerance);
        cells.emplace_back(hash_text(row.run.state_hash));
        cells.emplace_back(outcome_word(row.was_run, row.run));
        cells.emplace_back(row.run.message);
        table.rows.push_back(std::move(cells));
    }
    return table;
}

std::string notes_of(const reports::Precision& precision) {
    std::string text;
    if (precision.reference) {
        text += fmt::format("reference: {}, {}, {:.3g} s wall; its error, from the run at {}:\n",
                            precision.reference->method->name, precision.reference->text(),
                            precision.reference_run.wall_s, precision.second.text());
        for (std::size_t m = 0; m < all_error_measures().size(); ++m) {
            const double error = precision.reference_errors[m];
            text += fmt::format("  {:<14}{}\n", all_error_measures()[m].name,
                                std::isnan(error) ? "-" : fmt::format("{:.2g}", error));
        }
        if (!precision.reference_is_fine_enough())
            text += "'< ref': below ten times the error of the reference, so not shown\n";
        if (!precision.cost_of_floats.empty()) {
            text += "single precision of the contact kernel changes the reference by:\n";
            for (std::size_t m = 0; m < all_error_measures().size(); ++m) {
                const double change = precision.cost_of_floats[m];
                text += fmt::format("  {:<14}{}\n", all_error_measures()[m].name,
                                    std::isnan(change) ? "-" : fmt::format("{:.2g}", change));
            }
        }
    } else {
        text += "no reference: no method came through with a step and with half of it, or the time "
                "limit came first; so there are no errors\n";
    }
    if (precision.met_time_limit) text += "the time limit came before everything was done\n";
    for (const reports::PrecisionRow& row : precision.rows)
        if (row.was_run && !row.run.is_complete() && !row.run.message.empty())
            text += fmt::format("{}, {}: {}\n", row.setting.method->name, row.setting.text(),
                                row.run.message);
    return text;
}

nlohmann::json json_of(const reports::Precision& precision) {
    nlohmann::json runs = nlohmann::json::array();
    for (const reports::PrecisionRow& row : precision.rows) {
        nlohmann::json object = run_json(row.was_run, row.run);
        object["method"] = row.setting.method->name;
        object["timed_runs"] = row.n_runs;
        object["setting"] = setting_json(row.setting);
        nlohmann::json errors = nlohmann::json::object();
        for (std::size_t m = 0; m < all_error_measures().size(); ++m) {
            const TableCell cell = error_cell(precision, row, m);
            const double* number = std::get_if<double>(&cell);
            errors[std::string(all_error_measures()[m].name)] =
                number != nullptr ? nlohmann::json(*number) : nlohmann::json();
        }
        object["errors"] = errors;
        runs.push_back(std::move(object));
    }
    nlohmann::json document{{"runs", runs}, {"met_time_limit", precision.met_time_limit}};
    document["reference"] = nullptr;
    if (precision.reference) {
        nlohmann::json errors = nlohmann::json::object();
        for (std::size_t m = 0; m < all_error_measures().size(); ++m)
            errors[std::string(all_error_measures()[m].name)] =
                number_or_null(precision.reference_errors[m]);
        nlohmann::json reference = run_json(true, precision.reference_run);
        reference["method"] = precision.reference->method->name;
        reference["setting"] = setting_json(*precision.reference);
        reference["checked_against"] = setting_json(precision.second);
        reference["errors"] = errors;
        reference["is_fine_enough"] = precision.reference_is_fine_enough();
        document["reference"] = reference;
    }
    document["cost_of_floats"] = nullptr;
    if (!precision.cost_of_floats.empty()) {
        nlohmann::json changes = nlohmann::json::object();
        for (std::size_t m = 0; m < all_error_measures().size(); ++m)
            changes[std::string(all_error_measures()[m].name)] =
                number_or_null(precision.cost_of_floats[m]);
        document["cost_of_floats"] = changes;
    }
    return document;
}

reports::Plot plot_of(const reports::Precision& precision, const std::string& title) {
    reports::Plot plot;
    plot.title = title;
    for (std::size_t m = 0; m < all_error_measures().size(); ++m) {
        if (all_error_measures()[m].title.empty()) continue;
        reports::Plot::Panel panel = panel_of(precision, m);
        bool has_points = false;
        for (const reports::Plot::Series& series : panel.series)
            has_points = has_points || !series.x.empty();
        if (has_points) plot.panels.push_back(std::move(panel));
    }
    plot.caption = caption_of(precision);
    return plot;
}

reports::ReportTable table_of(const reports::MeshLadder& ladder) {
    reports::ReportTable table;
    table.columns = {{"measure"}, {"unit"}};
    for (const reports::MeshLevel& level : ladder.levels)
        table.columns.push_back({fmt::format("{} nodes", level.nodes)});
    for (const char* name :
         {"extrapolated", "order", "mesh_error", "against", "time_error", "dominant"})
        table.columns.push_back({name});
    const auto or_word = [](double value, std::string_view word) -> TableCell {
        if (std::isfinite(value)) return value;
        return Missing{word};
    };
    for (std::size_t m = 0; m < ladder.results.size(); ++m) {
        const reports::MeshResult& result = ladder.results[m];
        std::vector<TableCell> cells{std::string(reports::all_mesh_measures()[m].name),
                                     std::string(reports::all_mesh_measures()[m].unit)};
        for (const double value : result.values) cells.push_back(or_word(value, "-"));
        cells.push_back(or_word(result.extrapolation.limit, "not resolved"));
        cells.push_back(or_word(result.extrapolation.order, "-"));
        cells.push_back(or_word(result.mesh_error, "-"));
        cells.push_back(std::isfinite(result.mesh_error) ? TableCell(reference_of(result))
                                                         : TableCell(Missing{"-"}));
        cells.push_back(or_word(result.time_error, "-"));
        cells.emplace_back(std::string(result.dominant()));
        table.rows.push_back(std::move(cells));
    }
    std::vector<TableCell> wall{std::string("wall time"), std::string("s")};
    for (const reports::MeshLevel& level : ladder.levels)
        wall.push_back(level.was_run ? TableCell(level.run.wall_s) : TableCell(Missing{"-"}));
    wall.insert(wall.end(), 5, Missing{""});
    wall.emplace_back(std::string());
    table.rows.push_back(std::move(wall));
    return table;
}

std::string notes_of(const reports::MeshLadder& ladder, int own_nodes) {
    int mesh = 0, time = 0, unknown = 0;
    for (const reports::MeshResult& result : ladder.results) {
        const std::string_view dominant = result.dominant();
        ++(dominant == "mesh" ? mesh : dominant == "time" ? time : unknown);
    }
    std::string text =
        fmt::format("at {} nodes with {}, {}: the mesh error dominates in {}, the time "
                    "error in {}; {} not known\n",
                    own_nodes, ladder.own.method->name, ladder.own.text(), counted(mesh, "measure"),
                    time, unknown);
    text += fmt::format("levels with {}, {}: they differ by the mesh alone, and the scene's own "
                        "setting from that on its mesh by the time error\n",
                        ladder.finer.method->name, ladder.finer.text());
    if (std::any_of(ladder.results.begin(), ladder.results.end(),
                    [](const reports::MeshResult& result) { return result.mesh_error_is_rough; }))
        text += "against the finest level where no limit can be extrapolated: a bound by size, "
                "whose digits mean nothing\n";
    if (ladder.met_time_limit) text += "the time limit came before everything was done\n";
    const auto note_failure = [&](const reports::MeshLevel& level, const std::string& setting) {
        if (level.was_run && !level.run.is_complete())
            text += fmt::format("{} nodes, {}: {} {}\n", level.nodes, setting,
                                outcome_word(true, level.run), level.run.message);
    };
    note_failure(ladder.own_run, ladder.own.text());
    note_failure(ladder.finer_run, ladder.finer.text());
    for (const reports::MeshLevel& level : ladder.levels)
        if (level.nodes != ladder.finer_run.nodes) note_failure(level, ladder.finer.text());
    return text;
}

reports::Plot plot_of(const reports::MeshLadder& ladder, int own_nodes, const std::string& title) {
    reports::Plot plot;
    plot.title = title;
    plot.legend_above = true;
    for (std::size_t m = 0; m < ladder.results.size(); ++m) {
        const reports::MeshResult& result = ladder.results[m];
        if (!result.extrapolation.is_resolved) continue;
        reports::Plot::Panel panel;
        panel.title = fmt::format("{}, order {:.2g}", reports::all_mesh_measures()[m].name,
                                  result.extrapolation.order);
        panel.x_title = "nodes of a cell";
        panel.y_title = "relative error";
        reports::Plot::Series mesh{.name = "mesh: difference to the extrapolated limit"};
        reports::Plot::Series time{.name = fmt::format("time: {}, {}, on {} nodes",
                                                       ladder.own.method->name, ladder.own.text(),
                                                       own_nodes),
                                   .line = reports::Plot::Line::dashed,
                                   .has_marks = false};
        for (std::size_t k = 0; k < ladder.levels.size(); ++k) {
            const double error = std::abs(result.values[k] / result.extrapolation.limit - 1.0);
            const auto place = static_cast<double>(k);  // edges are halved from level to level
            panel.x_axis.categories.push_back(std::to_string(ladder.levels[k].nodes));
            if (std::isfinite(error) && error > 0.0) {
                mesh.x.push_back(place);
                mesh.y.push_back(error);
            }
            if (std::isfinite(result.time_error) && result.time_error > 0.0) {
                time.x.push_back(place);
                time.y.push_back(result.time_error);
            }
        }
        panel.series = {std::move(mesh), std::move(time)};
        plot.panels.push_back(std::move(panel));
    }
    return plot;
}

nlohmann::json json_of(const reports::MeshLadder& ladder, int own_nodes) {
    nlohmann::json levels = nlohmann::json::array();
    for (const reports::MeshLevel& level : ladder.levels) {
        nlohmann::json object = run_json(level.was_run, level.run);
        object["nodes"] = level.nodes;
        levels.push_back(std::move(object));
    }
    nlohmann::json measures = nlohmann::json::array();
    for (std::size_t m = 0; m < ladder.results.size(); ++m) {
        const reports::MeshResult& result = ladder.results[m];
        nlohmann::json values = nlohmann::json::array();
        for (const double value : result.values) values.push_back(number_or_null(value));
        measures.push_back({{"measure", reports::all_mesh_measures()[m].name},
                            {"unit", reports::all_mesh_measures()[m].unit},
                            {"values", values},
                            {"extrapolated", number_or_null(result.extrapolation.limit)},
                            {"order", number_or_null(result.extrapolation.order)},
                            {"mesh_error", number_or_null(result.mesh_error)},
                            {"mesh_error_is_rough", result.mesh_error_is_rough},
                            {"time_error", number_or_null(result.time_error)},
                            {"dominant", result.dominant()}});
    }
    return {{"levels", levels},
            {"own_run", run_json(ladder.own_run.was_run, ladder.own_run.run)},
            {"measures", measures},
            {"own_nodes", own_nodes},
            {"own_setting", setting_json(ladder.own)},
            {"finer_setting", setting_json(ladder.finer)},
            {"met_time_limit", ladder.met_time_limit}};
}

}  // namespace spheroscope::cli
