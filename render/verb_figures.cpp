#include "engine/cli/json_output.hpp"
#include "engine/cli/log.hpp"
#include "engine/cli/measured_runs.hpp"
#include "engine/cli/report_output.hpp"
#include "engine/cli/seed_means_text.hpp"
#include "engine/statistics/setup_numbers.hpp"
#include "render/figures/figure.hpp"
#include "render/plot.hpp"
#include "render/verb_strip.hpp"
#include "render/verbs.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace spheroscope {
namespace {

using statistics::RunStatistics;
using statistics::SetupStatistics;

struct FiguresArguments {
    std::vector<std::string> files;
    std::vector<std::string> only;
    cli::CommonOptions common;
};

/// A run that no figure can use.
struct LeftOut {
    std::string file, reason;
};

struct Runs {
    std::vector<RunStatistics> measured;
    std::vector<LeftOut> left_out;
};

/// A file that cannot be read as a run is the user's mistake; a run that holds nothing to measure
/// is left out, with its reason.
Runs measure_files(const std::vector<std::string>& files) {
    Runs runs;
    for (const std::string& file : files) {
        try {
            runs.measured.push_back(cli::measure_stored_run(file));
            cli::log_info(fmt::format("{}: measured", file));
        } catch (const cli::NothingToMeasure& error) {
            runs.left_out.push_back({file, error.reason()});
        }
    }
    return runs;
}

/// What a reader of all figures has to know about the runs behind them.
std::vector<std::string> remarks_on(const std::vector<SetupStatistics>& setups,
                                    const std::vector<LeftOut>& left_out) {
    std::vector<std::string> remarks;
    for (const LeftOut& run : left_out)
        remarks.push_back(fmt::format("left out: {}: {}", run.file, run.reason));
    for (std::string& remark : figures::remarks_on_runs(setups))
        remarks.push_back(std::move(remark));
    return remarks;
}

/// Breaks a text into lines of at most `n` characters, between words.
std::vector<std::string> lines_of(const std::string& text, std::size_t n) {
    std::vector<std::string> lines;
    std::size_t begin = 0;
    while (text.size() - begin > n) {
        std::size_t end = text.rfind(' ', begin + n);
        if (end == std::string::npos || end <= begin) end = std::min(text.size(), begin + n);
        lines.push_back(text.substr(begin, end - begin));
        begin = std::min(text.size(), text[end] == ' ' ? end + 1 : end);
    }
    lines.push_back(text.substr(begin));
    return lines;
}

constexpr std::size_t k_most_remarks = 4, k_most_command_lines = 3;

/// Caption of a picture: what the figure says of itself, what is missing, and the command.
void add_to_caption(reports::Plot& plot, const std::vector<std::string>& remarks,
                    const cli::Invocation& invocation) {
    const int columns = std::min(plot.columns, static_cast<int>(plot.panels.size()));
    const auto n =
        static_cast<std::size_t>(columns) * 68U;  // characters in the width of the panels
    std::vector<std::string> lines;
    for (const std::string& line : plot.caption)
        for (const std::string& part : lines_of(line, n)) lines.push_back(part);
    for (std::size_t i = 0; i < remarks.size() && i < k_most_remarks; ++i)
        for (const std::string& part : lines_of(remarks[i], n)) lines.push_back(part);
    if (remarks.size() > k_most_remarks)
        lines.push_back(
            fmt::format("and {} more remarks in the CSV", remarks.size() - k_most_remarks));
    std::vector<std::string> command =
        lines_of(fmt::format("Made by: {} ({})", invocation.command_line, invocation.version), n);
    if (command.size() > k_most_command_lines) {
        constexpr std::string_view more = " ... (all of it in the CSV)";
        command.resize(k_most_command_lines);
        command.back() = lines_of(command.back(), n - more.size()).front();
        command.back() += more;
    }
    lines.insert(lines.end(), command.begin(), command.end());
    plot.caption = lines;
}

/// CSV, PNG and SVG of one figure; returns their names.
std::vector<std::string> write_figure(figures::Figure& figure, const std::string& path,
                                      const std::vector<std::string>& remarks,
                                      const cli::Invocation& invocation) {
    // Of the runs first: a picture has room for a few.
    std::vector<std::string> all_remarks = remarks;
    all_remarks.insert(all_remarks.end(), figure.missing.begin(), figure.missing.end());
    std::vector<std::string> comments = cli::report_comments(invocation, 0);
    comments.insert(comments.end(), figure.plot.caption.begin(), figure.plot.caption.end());
    comments.insert(comments.end(), all_remarks.begin(), all_remarks.end());
    cli::write_text_file(path + ".csv", figure.table.csv_text(comments));
    std::vector<std::string> files{path + ".csv"};
    add_to_caption(figure.plot, all_remarks, invocation);
    std::string caption;
    for (const std::string& line : figure.plot.caption) caption += line + "\n";
    render::draw_plot(figure.plot, path + ".png", path + ".svg",
                      {{"Title", figure.plot.title},
                       {"Description", caption},
                       {"Command", invocation.command_line},
                       {"Software", "spheroscope " + invocation.version}});
    files.push_back(path + ".png");
    files.push_back(path + ".svg");
    return files;
}

/// The figure that is made of pictures of one run: drawn where it is asked for by name.
constexpr std::string_view k_strip = "fig1";

std::vector<const figures::FigureRow*> wanted_figures(const std::vector<std::string>& names) {
    std::vector<const figures::FigureRow*> wanted;
    std::string all(k_strip);
    for (const figures::FigureRow& row : figures::all_figures()) {
        all += ", " + std::string(row.name);
        if (names.empty() || std::find(names.begin(), names.end(), row.name) != names.end())
            wanted.push_back(&row);
    }
    for (const std::string& name : names)
        if (name != k_strip && std::none_of(wanted.begin(), wanted.end(),
                                            [&](const auto* row) { return row->name == name; }))
            throw Error("there is no figure '" + name + "'", "figures are " + all);
    return wanted;
}

/// Fig. 1: the way of one run, the last frames of its stages beside each other. Returns its file.
std::string draw_way_of_run(const std::string& file, const std::string& folder,
                            const cli::Invocation& invocation) {
    const RunFileReader reader(file);
    std::set<std::string> stages;
    for (int i = 0; i < reader.n_frames(); ++i) stages.insert(reader.frame(i)->stage_name);
    std::string list;
    for (const char* stage : {"anneal", "compact", "relax", "indent"})
        if (stages.contains(stage)) list += (list.empty() ? "" : ",") + std::string(stage);
    if (list.empty()) list = "0,-1";
    scene::Picture picture = pictures_of(reader, {}).front();
    picture.size_px = {900, 720};
    picture.network = picture.stress_axes = false;
    std::string path = fmt::format("{}/{}.png", folder, k_strip);
    draw_strip(reader, picture, list, StripRange::without_wall, "Fig. 1: the way of one run", path,
               invocation);
    return path;
}

nlohmann::json json_of(const SetupStatistics& setup) {
    nlohmann::json runs = nlohmann::json::array();
    for (const RunStatistics& run : setup.runs)
        runs.push_back({{"file", run.file},
                        {"seed", run.seed},
                        {"outcome", run.outcome},
                        {"stage", run.stage_name},
                        {"time_s", run.time_s}});
    nlohmann::json numbers = nlohmann::json::object();
    for (const statistics::SetupNumber& number : statistics::numbers_of(setup))
        numbers[number.name] = {
            {"unit", number.unit},
            {"mean", cli::number_or_null(number.estimate.mean)},
            {"standard_error", cli::number_or_null(number.estimate.standard_error)},
            {"seeds", number.estimate.n}};
    return {{"label", setup.label}, {"runs", runs}, {"numbers", numbers}};
}

/// Numbers of all setups side by side, with their errors.
reports::ReportTable table_of(const std::vector<SetupStatistics>& setups) {
    reports::ReportTable table;
    table.columns = {{"setup"}, {"number"}, {"unit"}, {"mean"}, {"standard_error"}, {"seeds"}};
    for (const SetupStatistics& setup : setups)
        for (const statistics::SetupNumber& number : statistics::numbers_of(setup))
            table.rows.push_back({setup.label, number.name, number.unit, number.estimate.mean,
                                  number.estimate.standard_error, std::int64_t{number.estimate.n}});
    return table;
}

std::string text_of(const SetupStatistics& setup) {
    std::string seeds;
    for (const RunStatistics& run : setup.runs)
        seeds += fmt::format("{}{} ({})", seeds.empty() ? "" : ", ", run.seed,
                             run.outcome.empty() ? "not ended" : run.outcome);
    std::string text = fmt::format("{}\n  {:<32} {}\n", setup.label, "seeds", seeds);
    for (const statistics::SetupNumber& number : statistics::numbers_of(setup))
        text += fmt::format(
            "  {:<32} {}{}\n", number.name,
            cli::with_error(number.estimate.mean, number.estimate.standard_error),
            number.unit == "1" || std::isnan(number.estimate.mean) ? "" : " " + number.unit);
    return text;
}

ExitCode make_figures(const FiguresArguments& arguments, const cli::Invocation& invocation) {
    if (arguments.common.quiet) cli::make_log_quiet();
    if (arguments.files.empty())
        throw Error("figures wants the files of runs, got none",
                    "spheroscope figures out/*/run.h5 -o out/figures");
    const std::vector<const figures::FigureRow*> wanted = wanted_figures(arguments.only);
    const Runs runs = measure_files(arguments.files);
    for (const LeftOut& run : runs.left_out)
        cli::log_warning(fmt::format("{}: left out: {}", run.file, run.reason));
    if (runs.measured.empty())
        throw Error("none of these runs can serve a figure", "the reasons are above");
    const std::vector<SetupStatistics> setups = statistics::group_by_setup(runs.measured);
    const std::vector<std::string> remarks = remarks_on(setups, runs.left_out);
    const std::string folder = cli::report_folder(arguments.common, "out/figures");

    nlohmann::json drawn = nlohmann::json::array();
    std::vector<std::string> files;
    for (const figures::FigureRow* row : wanted) {
        figures::Figure figure = row->make(setups);
        const std::string name(row->name);
        std::vector<std::string> of_figure;
        if (figure.plot.panels.empty())
            for (const std::string& reason : figure.missing)
                cli::log_warning(fmt::format("{} is not drawn: {}", name, reason));
        else
            of_figure = write_figure(figure, folder + "/" + name, remarks, invocation);
        drawn.push_back({{"name", name},
                         {"title", row->title},
                         {"files", of_figure},
                         {"missing", figure.missing}});
        files.insert(files.end(), of_figure.begin(), of_figure.end());
    }
    if (std::find(arguments.only.begin(), arguments.only.end(), k_strip) != arguments.only.end()) {
        files.push_back(draw_way_of_run(runs.measured.front().file, folder, invocation));
        drawn.push_back({{"name", k_strip},
                         {"title", "the way of one run: its stages as pictures"},
                         {"files", {files.back()}},
                         {"missing", nlohmann::json::array()}});
    }
    const std::string numbers = folder + "/numbers.csv";
    cli::write_text_file(numbers, table_of(setups).csv_text(cli::report_comments(invocation, 0)));
    files.push_back(numbers);

    if (arguments.common.json) {
        nlohmann::json of_setups = nlohmann::json::array();
        for (const SetupStatistics& setup : setups) of_setups.push_back(json_of(setup));
        nlohmann::json left_out = nlohmann::json::array();
        for (const LeftOut& run : runs.left_out)
            left_out.push_back({{"file", run.file}, {"reason", run.reason}});
        cli::print_json({{"setups", of_setups},
                         {"figures", drawn},
                         {"left_out", left_out},
                         {"remarks", remarks},
                         {"files", files}});
        return ExitCode::ok;
    }
    for (const SetupStatistics& setup : setups) fmt::print("{}\n", text_of(setup));
    for (const std::string& remark : remarks) fmt::print("{}\n", remark);
    for (const auto& figure : drawn)
        for (const auto& missing : figure["missing"])
            fmt::print("{}: {}\n", figure["name"].get<std::string>(), missing.get<std::string>());
    for (const std::string& file : files) fmt::print("written to {}\n", file);
    return ExitCode::ok;
}

}  // namespace

cli::Verb figures_verb() {
    return {"figures",
            "the paper's plots from stored runs of one or more setups and seeds: PNG, SVG, CSV",
            [](cli::CommandLine& command) -> cli::VerbAction {
                using cli::CommonOption;
                const auto arguments = std::make_shared<FiguresArguments>();
                command.optional_arguments("FILES", arguments->files,
                                           "HDF5 files of runs; seeds of one setup are pooled");
                command.option(
                    "--only", arguments->only,
                    "this figure only: fig1, fig2, fig3, fig4, fig5, fig7 or force_displacement; "
                    "may be given several times. fig1 shows the first run and is drawn by name "
                    "alone");
                cli::add_common_options(
                    command, arguments->common,
                    {CommonOption::output_folder, CommonOption::json, CommonOption::quiet});
                return [arguments](const cli::Invocation& invocation) {
                    return make_figures(*arguments, invocation);
                };
            }};
}

}  // namespace spheroscope
