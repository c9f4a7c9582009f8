#include "engine/base/counted.hpp"
#include "engine/cli/interrupt.hpp"
#include "engine/cli/json_output.hpp"
#include "engine/cli/log.hpp"
#include "engine/cli/progress.hpp"
#include "engine/cli/report_output.hpp"
#include "engine/cli/verb.hpp"
#include "engine/contact/simd_target.hpp"
#include "engine/reports/engine_bench.hpp"
#include "engine/reports/machine.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

namespace spheroscope::cli {
namespace {

const std::vector<std::string> k_precisions{"float", "double"};

std::string problem_of_precision(const std::string& name) {
    if (std::find(k_precisions.begin(), k_precisions.end(), name) != k_precisions.end()) return "";
    return fmt::format("wanted {}, got '{}'", fmt::join(k_precisions, " or "), name);
}

struct BenchArguments {
    bool quick = false;
    std::optional<int> cells, nodes;  ///< only sizes with these
    int repetitions = 5;
    std::string precision = k_precisions.front();  ///< of the contact kernel
    CommonOptions common;
};

/// A time per thing where there are things; else nothing.
double time_or_nothing(double ns, std::int64_t things) {
    return things > 0 ? ns : std::numeric_limits<double>::quiet_NaN();
}

nlohmann::json json_of(const ContactTiming::Kernel& kernel) {
    return {{"candidates", kernel.candidates},
            {"active_pairs", kernel.active_pairs},
            {"ns_per_candidate",
             number_or_null(time_or_nothing(kernel.ns_per_candidate, kernel.candidates))},
            {"ns_per_active_pair",
             number_or_null(time_or_nothing(kernel.ns_per_active_pair, kernel.active_pairs))}};
}

nlohmann::json json_of(const reports::BenchTime& time) {
    return {{"wall_ms", time.wall_ms}, {"cpu_ms", time.cpu_ms}};
}

nlohmann::json json_of(const reports::BenchRow& row) {
    nlohmann::json terms = nlohmann::json::object(), steps = nlohmann::json::array();
    for (const reports::BenchTerm& term : row.terms) terms[term.name] = json_of(term.time);
    for (const reports::BenchStep& step : row.steps)
        steps.push_back({{"method", step.method},
                         {"time", json_of(step.time)},
                         {"dt_s", step.dt_s},
                         {"step_error_um", step.error_um},
                         {"linear_iterations", step.linear_iterations},
                         {"message", step.message},
                         {"hash", hash_text(step.state_hash)}});
    return {{"cells", row.size.cells},
            {"nodes", row.size.nodes},
            {"threads", row.size.threads},
            {"contact", json_of(row.contact.simd)},
            {"plain_contact", json_of(row.contact.plain)},
            {"simd", row.contact.target},
            {"force", json_of(row.force)},
            {"force_error", number_or_null(row.force_error)},
            {"force_and_stiffness", json_of(row.stiffness)},
            {"terms", terms},
            {"solve", json_of(row.solve)},
            {"solve_dt_s", row.solve_dt_s},
            {"solve_iterations", row.solve_iterations},
            {"solve_residual", row.solve_residual},
            {"steps", steps},
            {"memory_MB", number_or_null(row.memory_MB)}};
}

/// One line for each size and method; what does not depend on the method is repeated.
reports::ReportTable table_of(const std::vector<reports::BenchRow>& rows) {
    reports::ReportTable table;
    table.columns = {{"cells"},
                     {"nodes"},
                     {"threads"},
                     {"active_pairs"},
                     {"candidates", false},
                     {"ns_per_candidate"},
                     {"ns_per_active"},
                     {"ns_plain"},
                     {"force_cpu_ms"},
                     {"force_wall_ms", false},
                     {"force_error"},
                     {"stiffness_cpu_ms", false},
                     {"solve_cpu_ms"},
                     {"solve_iterations"},
                     {"solve_residual"},
                     {"method"},
                     {"dt_s"},
                     {"step_cpu_ms"},
                     {"step_wall_ms"},
                     {"step_error_um"},
                     {"iterations"},
                     {"memory_MB"},
                     {"state_hash", false},
                     {"message", false}};
    for (const reports::BenchRow& row : rows)
        for (const reports::BenchStep& step : row.steps) {
            const ContactTiming::Kernel& simd = row.contact.simd;
            const ContactTiming::Kernel& plain = row.contact.plain;
            table.rows.push_back(
                {std::int64_t{row.size.cells},
                 std::int64_t{row.size.nodes},
                 std::int64_t{row.size.threads},
                 simd.active_pairs,
                 simd.candidates,
                 time_or_nothing(simd.ns_per_candidate, simd.candidates),
                 time_or_nothing(simd.ns_per_active_pair, simd.active_pairs),
                 time_or_nothing(plain.ns_per_active_pair, plain.active_pairs),
                 row.force.cpu_ms,
                 row.force.wall_ms,
                 row.force_error,
                 row.stiffness.cpu_ms,
                 row.solve.cpu_ms,
                 std::int64_t{row.solve_iterations},
                 row.solve_residual,
                 step.method,
                 step.dt_s,
                 step.message.empty() ? reports::TableCell(step.time.cpu_ms)
                                      : reports::TableCell(reports::Missing{"failed"}),
                 step.message.empty() ? reports::TableCell(step.time.wall_ms)
                                      : reports::TableCell(reports::Missing{"failed"}),
                 step.error_um,
                 std::int64_t{step.linear_iterations},
                 row.memory_MB,
                 hash_text(step.state_hash),
                 step.message});
        }
    return table;
}

std::vector<reports::BenchSize> chosen_sizes(const BenchArguments& arguments) {
    std::vector<reports::BenchSize> sizes = reports::bench_sizes(
        arguments.quick ? reports::BenchExtent::quick : reports::BenchExtent::full);
    std::string known;
    for (const reports::BenchSize& size : sizes)
        if (size.threads == 1) known += fmt::format(" {} x {}", size.cells, size.nodes);
    std::erase_if(sizes, [&](const reports::BenchSize& size) {
        return size.cells != arguments.cells.value_or(size.cells) ||
               size.nodes != arguments.nodes.value_or(size.nodes);
    });
    if (sizes.empty()) throw Error("there is no such size", "sizes are, cells x nodes:" + known);
    return sizes;
}

ExitCode bench(const BenchArguments& arguments, const Invocation& invocation) {
    if (arguments.common.quiet) make_log_quiet();
    const std::string folder = report_folder(arguments.common, "out/bench");
    const InterruptGuard interrupts;
    Progress progress(progress_style(arguments.common.quiet));
    const double limit_s = arguments.common.time_limit_s().value_or(0.0);
    const double begin_s = reports::wall_clock_s();
    const std::vector<reports::BenchSize> sizes = chosen_sizes(arguments);
    if (!arguments.common.simd.empty()) static_cast<void>(use_simd_target(arguments.common.simd));
    reports::BenchOptions options;
    options.repetitions.most = arguments.repetitions;
    options.repetitions.stop = &interrupts.stop();
    options.precision = arguments.precision == "double" ? scene::Precision::double_precision
                                                        : scene::Precision::single_precision;
    std::vector<reports::BenchRow> rows;
    bool is_complete = true;
    for (std::size_t k = 0; k < sizes.size(); ++k) {
        const bool is_late = limit_s > 0.0 && reports::wall_clock_s() - begin_s >= limit_s;
        if (is_late || interrupts.stop().load()) {
            is_complete = false;
            break;
        }
        constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
        progress.update({fmt::format("{}, {} nodes, {}", counted(sizes[k].cells, "cell"),
                                     sizes[k].nodes, counted(sizes[k].threads, "thread")),
                         static_cast<double>(k) / static_cast<double>(sizes.size()), unknown,
                         unknown});
        std::optional<reports::BenchRow> row = reports::run_bench(sizes[k], options);
        if (!row) {
            is_complete = false;
            break;
        }
        rows.push_back(std::move(*row));
    }
    progress.clear();

    const reports::ReportTable table = table_of(rows);
    nlohmann::json document{
        {"rows", nlohmann::json::array()},    {"machine", machine_json(invocation, 0)},
        {"command", invocation.command_line}, {"simd", simd_target()},
        {"precision", arguments.precision},   {"complete", is_complete}};
    for (const reports::BenchRow& row : rows) document["rows"].push_back(json_of(row));
    std::vector<std::string> comments = report_comments(invocation, 0);
    comments.push_back(fmt::format("contact kernel: {}, {}", arguments.precision, simd_target()));
    write_text_file(folder + "/bench.csv", table.csv_text(comments));
    write_text_file(folder + "/bench.json", document.dump(1) + "\n");
    if (arguments.common.json)
        print_json(document);
    else
        fmt::print("{}\nwritten to {}/bench.csv and bench.json\n", table.aligned_text(), folder);
    return code_after_signal(is_complete ? ExitCode::ok : ExitCode::not_converged);
}

}  // namespace

Verb bench_verb() {
    return {
        "bench", "what the parts of a step cost, with the error at that cost",
        [](CommandLine& command) -> VerbAction {
            const auto arguments = std::make_shared<BenchArguments>();
            command.flag("--quick", arguments->quick, "the small sizes only, in seconds");
            command.option("--cells", arguments->cells, "sizes of so many cells only",
                           between(1, 1'000'000));
            command.option("--nodes", arguments->nodes, "sizes of so many nodes a cell only",
                           between(1, 1'000'000));
            command.option("--repetitions", arguments->repetitions,
                           "of every timing, fewer where it takes more than 2 s; the least counts",
                           between(1, 1000));
            command.option("--precision", arguments->precision,
                           "of the contact kernel: float or double (default: float)",
                           {"PRECISION", problem_of_precision});
            add_common_options(command, arguments->common,
                               {CommonOption::output_folder, CommonOption::simd, CommonOption::json,
                                CommonOption::quiet, CommonOption::time_limit});
            return
                [arguments](const Invocation& invocation) { return bench(*arguments, invocation); };
        }};
}

}  // namespace spheroscope::cli
