#include "engine/cli/run_seeds.hpp"

#include "engine/base/counted.hpp"
#include "engine/cli/json_output.hpp"
#include "engine/cli/log.hpp"
#include "engine/cli/progress.hpp"
#include "engine/cli/seed_means_text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace spheroscope::cli {
namespace {

/// What became of one seed.
struct SeedRun {
    std::uint64_t seed;
    RunPlace place;
    ExitCode code = ExitCode::internal;
    std::string outcome{}, reason{};
    double time_s = 0.0, wall_s = 0.0;
    Totals totals{};

    [[nodiscard]] bool came_to_its_end() const {
        return code == ExitCode::ok || code == ExitCode::differs;
    }
    [[nodiscard]] bool was_interrupted() const {
        return code == ExitCode::interrupted || code == ExitCode::terminated;
    }
};

std::string unmet_expectations(const SimulationSummary& summary) {
    std::string text;
    for (const Expectation& row : summary.expectations)
        if (!row.met)
            text += fmt::format("{}{} = {:.4g} is not in [{:.4g}, {:.4g}]",
                                text.empty() ? "" : "; ", row.measure, row.value, row.min, row.max);
    return text;
}

SeedRun run_seed(const std::string& scene_file, std::uint64_t seed, const std::string& folder,
                 const CommonOptions& options, bool overwrite, const Invocation& invocation) {
    SeedRun run{.seed = seed, .place = {fmt::format("{}/seed_{}", folder, seed)}};
    CommonOptions of_seed = options;
    of_seed.seed = seed;
    try {
        const scene::Scene scene = scene::load_scene(scene_file, of_seed.overrides());
        const SimulationSummary summary =
            simulate(scene, run.place, of_seed, overwrite, invocation);
        run.code = summary.code;
        run.outcome = summary.result.outcome;
        run.reason = summary.result.message;
        if (run.code == ExitCode::differs) run.reason = unmet_expectations(summary);
        if (run.code == ExitCode::not_converged && run.reason.empty())
            run.reason = "it did not come to its end in time";
        run.time_s = summary.result.time_s;
        run.wall_s = summary.result.wall_s;
        run.totals = summary.result.totals;
    } catch (const Error& error) {
        run.code = error.code();
        run.outcome = "failed";
        run.reason = error.what();
    }
    return run;
}

std::vector<Totals> totals_of_ended(const std::vector<SeedRun>& runs) {
    std::vector<Totals> totals;
    for (const SeedRun& run : runs)
        if (run.came_to_its_end()) totals.push_back(run.totals);
    return totals;
}

std::string text_of(const std::vector<SeedRun>& runs, std::size_t n_wanted) {
    std::string text;
    for (const SeedRun& run : runs) {
        text += fmt::format("seed {:<6} {:<12} t = {:<9} {:<8} {}\n", run.seed, run.outcome,
                            fmt::format("{:.4g} s", run.time_s), duration_text(run.wall_s),
                            run.place.run_file());
        if (!run.reason.empty()) text += fmt::format("  because: {}\n", run.reason);
    }
    const std::vector<Totals> totals = totals_of_ended(runs);
    text += fmt::format("\n{} of {} came to the end", totals.size(), counted(n_wanted, "seed"));
    if (totals.empty()) return text + "\n";
    return text + "; mean +- standard error over them:\n" + seed_means_text(totals);
}

nlohmann::json json_of(const std::vector<SeedRun>& runs, ExitCode code) {
    nlohmann::json seeds = nlohmann::json::array();
    for (const SeedRun& run : runs)
        seeds.push_back({{"seed", run.seed},
                         {"file", run.place.run_file()},
                         {"outcome", run.outcome},
                         {"reason", run.reason},
                         {"exit_code", static_cast<int>(run.code)},
                         {"time_s", run.time_s},
                         {"wall_s", run.wall_s}});
    return {{"seeds", seeds},
            {"totals", seed_means_json(totals_of_ended(runs))},
            {"exit_code", static_cast<int>(code)}};
}

ExitCode code_of(const std::vector<SeedRun>& runs) {
    if (runs.back().was_interrupted()) return runs.back().code;
    ExitCode code = ExitCode::ok;
    for (const SeedRun& run : runs) {
        if (run.code == ExitCode::ok || run.code == code) continue;
        // Seeds that failed for different reasons: the reasons are in the report.
        const bool is_first = code == ExitCode::ok || code == ExitCode::differs;
        if (run.came_to_its_end() && !is_first) continue;
        code = is_first ? run.code : ExitCode::not_converged;
    }
    return code;
}

}  // namespace

ExitCode run_seeds(const std::string& scene_file, const std::vector<std::uint64_t>& seeds,
                   const CommonOptions& options, bool overwrite, const Invocation& invocation) {
    // A mistake in the scene is the same for all seeds.
    const scene::Scene scene = scene::load_scene(scene_file, options.overrides());
    log_warnings(scene.warnings);
    const std::string folder = run_place(scene_file, options).folder;
    std::vector<SeedRun> runs;
    for (const std::uint64_t seed : seeds) {
        log_info(fmt::format("seed {} ({} of {})", seed, runs.size() + 1, seeds.size()));
        runs.push_back(run_seed(scene_file, seed, folder, options, overwrite, invocation));
        if (runs.back().was_interrupted()) break;
        if (!runs.back().came_to_its_end())
            log_error(fmt::format("seed {} failed: {}", seed, runs.back().reason));
    }
    const ExitCode code = code_of(runs);
    if (options.json)
        print_json(json_of(runs, code));
    else
        fmt::print("{}", text_of(runs, seeds.size()));
    return code;
}

}  // namespace spheroscope::cli
