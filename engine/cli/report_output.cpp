#include "engine/cli/report_output.hpp"

#include "engine/base/counted.hpp"
#include "engine/base/make_folder.hpp"
#include "engine/base/whole_file.hpp"
#include "engine/cli/interrupt.hpp"
#include "engine/cli/log.hpp"
#include "engine/reports/machine.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace spheroscope::cli {

std::string report_place(const CommonOptions& options, const std::string& standard) {
    return options.output.empty() ? standard : options.output;
}

std::string report_folder(const CommonOptions& options, const std::string& standard) {
    const std::string folder = report_place(options, standard);
    make_folder(folder);
    return folder;
}

void refuse_own_input(const std::string& output, const std::string& input) {
    std::error_code none_is_there;
    if (std::filesystem::equivalent(output, input, none_is_there) && !none_is_there)
        throw Error(output + ": this file is read here, and would be replaced",
                    "-o writes elsewhere");
}

void write_text_file(const std::string& path, const std::string& text) {
    WholeFile whole(path);
    std::ofstream file(whole.working_path(), std::ios::binary);
    file << text;
    file.close();
    if (file && !whole.publish()) return;
    throw Error(path + ": the report could not be written",
                "is the disk full, or the folder protected?", ExitCode::environment);
}

std::vector<std::string> report_comments(const Invocation& invocation, int n_threads) {
    const reports::Machine machine = reports::this_machine();
    std::string used;
    if (n_threads > 0) used = fmt::format(", {} used", counted(n_threads, "thread"));
    return {
        "spheroscope " + invocation.version, "command: " + invocation.command_line,
        fmt::format("machine: {}, {}{}", machine.processor, counted(machine.cores, "core"), used)};
}

nlohmann::json machine_json(const Invocation& invocation, int n_threads) {
    const reports::Machine machine = reports::this_machine();
    nlohmann::json document{{"processor", machine.processor},
                            {"cores", machine.cores},
                            {"version", invocation.version}};
    if (n_threads > 0) document["threads"] = n_threads;
    return document;
}

nlohmann::json vector_json(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

std::string vector_text(const Vec3& v) {
    return fmt::format("({:.4g}, {:.4g}, {:.4g})", v.x(), v.y(), v.z());
}

nlohmann::json number_or_null(double value) {
    return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json();
}

std::vector<std::string> draw_report_plot(const reports::DrawPlot& draw, const reports::Plot& plot,
                                          const std::string& path) {
    bool has_points = false;
    for (const reports::Plot::Panel& panel : plot.panels)
        for (const reports::Plot::Series& series : panel.series)
            has_points = has_points || !series.x.empty();
    if (!has_points) {
        log_warning("no plot: there is no number to draw");
        return {};
    }
    if (!draw) {
        log_info("no plot: this program was built without pictures (SPHEROSCOPE_RENDER)");
        return {};
    }
    return draw(plot, path);
}

}  // namespace spheroscope::cli
