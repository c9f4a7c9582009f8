#include "engine/cli/interrupt.hpp"
#include "engine/cli/json_output.hpp"
#include "engine/cli/log.hpp"
#include "engine/cli/progress.hpp"
#include "engine/cli/report_output.hpp"
#include "engine/cli/verb.hpp"
#include "engine/reports/pull_off_force.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>

namespace spheroscope::cli {
namespace {

struct PullOffArguments {
    std::string scene;
    std::optional<double> rate_nN_per_s;
    CommonOptions common;
};

reports::ReportTable table_of(const std::vector<reports::PullOff>& rows) {
    reports::ReportTable table;
    table.columns = {{"variant"},     {"E_kPa"},  {"Et_over_gamma"}, {"area_at_rest_um2"}, {"F_nN"},
                     {"F_over_piRW"}, {"time_s"}, {"steps"},         {"problem"}};
    for (const reports::PullOff& row : rows) {
        const auto number = [&](double value) -> reports::TableCell {
            if (row.problem == reports::k_not_run) return reports::Missing{"-"};
            if (!row.problem.empty()) return reports::Missing{"failed"};
            return value;
        };
        table.rows.push_back({row.variant, row.E_kPa, row.Et_over_gamma, row.area_at_rest_um2,
                              number(row.force_nN), number(row.over_pi_R_W), row.time_s, row.steps,
                              row.problem});
    }
    return table;
}

ExitCode pull_off(const PullOffArguments& arguments, const reports::DrawPlot& draw,
                  const Invocation& invocation) {
    if (arguments.common.quiet) make_log_quiet();
    const std::string folder = report_folder(arguments.common, "out/pull_off");
    const InterruptGuard interrupts;
    reports::PullOffOptions options;
    options.rate_nN_per_s = arguments.rate_nN_per_s.value_or(options.rate_nN_per_s);
    options.threads = arguments.common.n_threads();
    options.stop = &interrupts.stop();
    Progress progress(progress_style(arguments.common.quiet));
    options.progress = [&](const std::string& variant, double share) {
        constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
        progress.update({variant, share, unknown, unknown});
    };
    const std::vector<reports::PullOff> rows =
        reports::measure_pull_off(arguments.scene, arguments.common.overrides(), options);
    progress.clear();
    const reports::ReportTable table = table_of(rows);
    std::vector<std::string> comments = report_comments(invocation, arguments.common.n_threads());
    comments.push_back(fmt::format("force grows by {} nN/s", options.rate_nN_per_s));
    write_text_file(folder + "/pull_off.csv", table.csv_text(comments));
    std::vector<std::string> files{folder + "/pull_off.csv"};
    for (const std::string& file :
         draw_report_plot(draw, reports::pull_off_plot(rows), folder + "/pull_off"))
        files.push_back(file);
    if (arguments.common.json) {
        nlohmann::json runs = nlohmann::json::array();
        for (const reports::PullOff& row : rows)
            runs.push_back({{"variant", row.variant},
                            {"E_kPa", row.E_kPa},
                            {"Et_over_gamma", row.Et_over_gamma},
                            {"area_at_rest_um2", row.area_at_rest_um2},
                            {"force_nN", row.force_nN},
                            {"over_pi_R_W", row.over_pi_R_W},
                            {"problem", row.problem}});
        print_json({{"scene", arguments.scene}, {"runs", runs}, {"files", files}});
    } else {
        fmt::print("{}", table.aligned_text());
        for (const std::string& file : files) fmt::print("written to {}\n", file);
    }
    const bool failed =
        std::any_of(rows.begin(), rows.end(), [](const auto& row) { return !row.problem.empty(); });
    return code_after_signal(failed ? ExitCode::not_converged : ExitCode::ok);
}

}  // namespace

Verb pull_off_verb(const reports::DrawPlot& draw) {
    return {"pull-off", "the force that parts two cells, for every variant of a scene",
            [draw](CommandLine& command) -> VerbAction {
                const auto arguments = std::make_shared<PullOffArguments>();
                command.argument("SCENE", arguments->scene,
                                 "two cells; scenes/claims/pull_off.toml is one");
                command.option("--rate", arguments->rate_nN_per_s,
                               "by which the force grows, nN/s (default 0.05)",
                               between(1e-4, 100.0));
                add_common_options(command, arguments->common,
                                   {CommonOption::output_folder, CommonOption::threads,
                                    CommonOption::seed, CommonOption::set, CommonOption::json,
                                    CommonOption::quiet});
                return [arguments, draw](const Invocation& invocation) {
                    return pull_off(*arguments, draw, invocation);
                };
            }};
}

}  // namespace spheroscope::cli
