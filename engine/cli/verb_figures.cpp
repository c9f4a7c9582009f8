// The paper's plots from the file of a run. A figure is one row of the table below: what it needs,
// and how it is made. What a run does not have is said, and is no error.

#include "engine/cli/json_output.hpp"
#include "engine/cli/log.hpp"
#include "engine/cli/options.hpp"
#include "engine/cli/report_output.hpp"
#include "engine/cli/verb.hpp"
#include "engine/store/run_file.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>

namespace spheroscope::cli {
namespace {

struct Figure {
    reports::ReportTable table;
    reports::Plot plot;
};

struct FigureRow {
    std::string_view name;   ///< of its files
    std::string_view needs;  ///< said where the run does not have it
    std::optional<Figure> (*make)(const RunFileReader&);
};

/// Force on the probe and on the hull over the probe's way (Cuvelier et al. 2021, Appendix G).
std::optional<Figure> force_displacement(const RunFileReader& reader) {
    Figure figure;
    figure.table.columns = {{"time_s"}, {"way_um"}, {"probe_nN"}, {"hull_nN"}, {"imbalance"}};
    reports::Plot::Series probe{"bead", {}, {}}, hull{"hull", {}, {}};
    for (int i = 0; i < reader.n_frames(); ++i) {
        const SnapshotPtr frame = reader.frame(i);
        const Totals& t = frame->totals;
        if (std::isnan(t.probe_force_nN)) continue;
        figure.table.rows.push_back(
            {frame->time_s, t.probe_way_um, t.probe_force_nN, t.hull_force_nN, t.load_imbalance});
        for (const auto& [series, force_nN] :
             {std::pair{&probe, t.probe_force_nN}, std::pair{&hull, t.hull_force_nN}}) {
            series->x.push_back(t.probe_way_um);
            series->y.push_back(force_nN);
        }
    }
    if (figure.table.rows.empty()) return {};
    figure.plot.title = reader.header()->title;
    figure.plot.panels = {{"Force of bead and hull on the cells",
                           "way of the bead (µm)",
                           "force (nN)",
                           {probe, hull},
                           reports::Plot::Axes::linear}};
    return figure;
}

constexpr std::array k_figures{
    FigureRow{"force_displacement", "frames of a stage of kind \"indent\"", force_displacement},
};

struct FiguresArguments {
    std::string file;
    CommonOptions common;
};

ExitCode figures(const FiguresArguments& arguments, const reports::DrawPlot& draw,
                 const Invocation& invocation) {
    if (arguments.common.quiet) make_log_quiet();
    const RunFileReader reader(arguments.file);
    const std::filesystem::path run = std::filesystem::absolute(arguments.file);
    const std::string folder =
        report_folder(arguments.common, (run.parent_path() / "figures").string());
    nlohmann::json made = nlohmann::json::array(), left_out = nlohmann::json::array();
    for (const FigureRow& row : k_figures) {
        const std::optional<Figure> figure = row.make(reader);
        if (!figure) {
            left_out.push_back({{"figure", row.name}, {"needs", row.needs}});
            if (!arguments.common.json)
                fmt::print("{}: not made, it needs {}\n", row.name, row.needs);
            continue;
        }
        const std::string path = (std::filesystem::path(folder) / row.name).string();
        write_text_file(path + ".csv",
                        figure->table.csv_text(report_comments(arguments.common, invocation)));
        std::vector<std::string> files{path + ".csv"};
        for (const std::string& file : draw_report_plot(draw, figure->plot, path))
            files.push_back(file);
        made.push_back({{"figure", row.name}, {"files", files}});
        if (!arguments.common.json)
            for (const std::string& file : files) fmt::print("written to {}\n", file);
    }
    const bool is_empty = made.empty();
    if (arguments.common.json)
        print_json({{"file", arguments.file}, {"figures", made}, {"left_out", left_out}});
    return is_empty ? ExitCode::usage : ExitCode::ok;
}

}  // namespace

Verb figures_verb(const reports::DrawPlot& draw) {
    return {"figures", "plots and CSVs of the paper's figures, from the file of a run",
            [draw](CommandLine& command) -> VerbAction {
                const auto arguments = std::make_shared<FiguresArguments>();
                command.argument("FILE", arguments->file, "HDF5 file of a run");
                add_common_options(command, arguments->common,
                                   {CommonOption::output, CommonOption::json, CommonOption::quiet});
                return [arguments, draw](const Invocation& invocation) {
                    return figures(*arguments, draw, invocation);
                };
            }};
}

}  // namespace spheroscope::cli
