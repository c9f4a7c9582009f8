#include "engine/base/counted.hpp"
#include "engine/claims/kept_report.hpp"
#include "engine/claims/verdict.hpp"
#include "engine/cli/bead_setup.hpp"
#include "engine/cli/interrupt.hpp"
#include "engine/cli/json_output.hpp"
#include "engine/cli/log.hpp"
#include "engine/cli/measured_runs.hpp"
#include "engine/cli/progress.hpp"
#include "engine/cli/report_output.hpp"
#include "engine/cli/simulate.hpp"
#include "engine/run/expectations.hpp"
#include "engine/store/run_file.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

namespace spheroscope::cli {
namespace {

using claims::ClaimedSetup;
using claims::ClaimTable;
using claims::JudgedClaim;
using claims::MeasuredSetup;
using claims::MeasuredSetups;
using claims::Verdict;

struct ReproduceArguments {
    std::string claims = SPHEROSCOPE_SCENES_DIR "/paper/paper.claims";
    std::vector<std::string> only;
    std::string keep;
    bool quick = false, full = false, stored = false;
    CommonOptions common;
};

/// Which runs are looked for, and whether those that are missing are made.
struct Extent {
    bool quick_seeds, makes_runs;
};

Extent extent_of(const ReproduceArguments& arguments) {
    if (int{arguments.quick} + int{arguments.full} + int{arguments.stored} != 1)
        throw Error("reproduce wants one of --quick, --full, --stored",
                    "--quick takes some minutes, --full hours; --stored judges the runs that "
                    "are there");
    return {arguments.quick, !arguments.stored};
}

/// A misspelt folder would be made, and filled with a report without data.
void check_is_there(const std::string& folder) {
    if (!std::filesystem::is_directory(folder))
        throw Error(folder + ": --stored wants a folder with runs, this one does not exist",
                    "--full makes the runs; -o names their folder, --keep one with stored numbers");
}

std::string run_folder(const std::string& folder, const ClaimedSetup& setup, std::uint64_t seed) {
    return fmt::format("{}/{}/seed={}", folder, setup.name, seed);
}

scene::Scene scene_of(const ClaimTable& table, const ClaimedSetup& setup, std::uint64_t seed) {
    CommonOptions options;
    options.set = setup.settings;
    options.seed = seed;
    return scene::load_scene(table.scene_path(setup), options.overrides());
}

/// Makes or ends one run. Throws Error with why there is none to measure.
void make_run(const scene::Scene& scene, const RunPlace& place, const CommonOptions& options,
              const Invocation& invocation) {
    CommonOptions of_run = options;
    of_run.output = place.folder;
    of_run.resume = true;
    const SimulationSummary summary = simulate(scene, place, of_run, false, invocation);
    const bool is_an_end =
        summary.result.verdict == RunVerdict::finished || summary.result.verdict == RunVerdict::cap;
    if (!is_an_end)
        throw Error(summary.result.outcome + ": " + summary.result.message, "", summary.code);
}

/// Whether the file holds the whole run of this scene. Throws Error when it is another one's.
bool is_made(const std::string& file, const scene::Scene& scene) {
    if (!std::filesystem::exists(file)) return false;
    const RunFileReader reader(file);
    if (!is_run_of(scene, *reader.header()))
        throw Error(file + ": this is a run of another scene, or of another version of it",
                    "delete it, or choose another folder with -o");
    return reader.is_complete();
}

/// One seed of a setup; nothing if it is not there and none is to be made.
std::optional<statistics::RunStatistics> measured_run(const ClaimTable& table,
                                                      const ClaimedSetup& setup, std::uint64_t seed,
                                                      const RunPlace& place, const Extent& extent,
                                                      const CommonOptions& options,
                                                      const Invocation& invocation) {
    const scene::Scene scene = scene_of(table, setup, seed);
    if (!is_made(place.run_file(), scene)) {
        if (!extent.makes_runs) return std::nullopt;
        log_info(fmt::format("{}, seed {}", setup.name, seed));
        make_run(scene, place, options, invocation);
    }
    return measure_stored_run(place.run_file());
}

/// A report that was itself kept from another one says some things already.
void add_remark(const std::string& remark, MeasuredSetup& setup) {
    std::vector<std::string>& said = setup.remarks;
    if (!remark.empty() && std::find(said.begin(), said.end(), remark) == said.end())
        said.push_back(remark);
}

MeasuredSetup measure_setup(const ClaimTable& table, const ClaimedSetup& setup,
                            const std::string& folder, const Extent& extent,
                            const CommonOptions& options, const Invocation& invocation) {
    const std::vector<std::uint64_t>& seeds = extent.quick_seeds ? setup.quick_seeds : setup.seeds;
    if (setup.beads > 0)
        return measure_beads(setup, folder, seeds, extent.makes_runs, invocation.version);
    MeasuredSetup measured;
    statistics::SetupStatistics runs;
    for (const std::uint64_t seed : seeds) {
        if (interrupt_signal() != 0) break;
        const RunPlace place{run_folder(folder, setup, seed)};
        try {
            auto run = measured_run(table, setup, seed, place, extent, options, invocation);
            if (!run) continue;
            measured.runs.push_back({run->seed,
                                     run->outcome,
                                     run->version,
                                     run->time_s,
                                     RunFileReader(place.run_file()).end().wall_time_s,
                                     run->totals,
                                     claims::scene_mark(scene_of(table, setup, seed).resolved_toml),
                                     {},
                                     run->last_dt_s});
            if (run->outcome == "cap")
                measured.remarks.push_back(fmt::format(
                    "seed {} ended at its cap of time, not at rest: t = {:.0f} s, {}", seed,
                    run->time_s, counted(run->totals.n_flipped_triangles, "flipped triangle")));
            for (const Expectation& row :
                 check_expectations(scene_of(table, setup, seed), run->totals))
                if (!row.met)
                    measured.remarks.push_back(
                        fmt::format("seed {} misses [expect] of its scene: {} is {:.4g}, not in "
                                    "[{:g}, {:g}] {}",
                                    seed, row.measure, row.value, row.min, row.max, row.unit));
            runs.runs.push_back(std::move(*run));
        } catch (const Error& error) {
            if (error.code() == ExitCode::interrupted || error.code() == ExitCode::terminated)
                break;
            log_error(fmt::format("{}, seed {}: {}", setup.name, seed, error.what()));
            measured.troubles.push_back(fmt::format("seed {}: {}", seed, error.what()));
        }
    }
    if (measured.runs.empty()) return measured;
    add_remark(claims::remark_on_motion(measured), measured);
    measured.numbers = statistics::numbers_of(runs);
    measured.law = runs.setup().law;
    measured.n_cells = runs.setup().n_cells;
    measured.n_nodes = runs.setup().n_nodes;
    return measured;
}

/// Setups that claims of the chosen extent need.
bool is_wanted(const ClaimedSetup& setup, const ReproduceArguments& arguments) {
    if (arguments.quick && setup.quick_seeds.empty()) return false;
    return arguments.only.empty() || std::find(arguments.only.begin(), arguments.only.end(),
                                               setup.name) != arguments.only.end();
}

void check_only(const ClaimTable& table, const std::vector<std::string>& only) {
    for (const std::string& name : only)
        if (table.find_setup(name) == nullptr) {
            std::string all;
            for (const ClaimedSetup& setup : table.setups)
                all += (all.empty() ? "" : ", ") + setup.name;
            throw Error(fmt::format("{}: there is no setup '{}'", table.file, name),
                        "setups are " + all);
        }
}

/// Adds the setups that have no runs here as an earlier report has them. Throws Error when one was
/// measured on another version of its scene.
void add_kept(const ClaimTable& table, const std::string& folder, MeasuredSetups& measured) {
    for (auto& [name, kept] : claims::kept_setups(folder)) {
        const ClaimedSetup* const setup = table.find_setup(name);
        if (setup == nullptr || measured.contains(name)) continue;
        bool is_marked = setup->beads > 0;
        for (const claims::MeasuredRun& run : kept.runs) {
            if (run.scene.empty()) continue;
            is_marked = true;
            if (run.scene != claims::scene_mark(scene_of(table, *setup, run.seed).resolved_toml))
                throw Error(fmt::format("{}: {}, seed {}, was measured on another version of {}",
                                        folder, name, run.seed, setup->scene),
                            "make its runs again with --full --only " + name);
        }
        if (!is_marked)
            add_remark("kept from a report that does not say of which version of the scene its "
                       "runs are",
                       kept);
        add_remark(claims::remark_on_motion(kept), kept);
        measured[name] = std::move(kept);
    }
}

/// What happened to the runs: one line for each that a reader has to know of, and the time.
std::vector<std::string> remarks_on(const MeasuredSetups& measured) {
    std::vector<std::string> remarks;
    double wall_s = 0.0;
    std::size_t n_runs = 0, n_failed = 0;
    for (const auto& [name, setup] : measured) {
        for (const std::string& text : setup.troubles) remarks.push_back(name + ", " + text);
        for (const std::string& text : setup.remarks) remarks.push_back(name + ", " + text);
        for (const claims::MeasuredRun& run : setup.runs) wall_s += run.wall_s;
        n_runs += setup.runs.size();
        n_failed += setup.troubles.size();
    }
    remarks.push_back(fmt::format("{}, {} of wall time in all; {} failed", counted(n_runs, "run"),
                                  duration_text(wall_s), n_failed));
    return remarks;
}

/// "12 agree, 3 differ, ..."
std::string verdicts_text(const std::vector<JudgedClaim>& judged) {
    std::string text;
    for (const auto verdict :
         {Verdict::agrees, Verdict::differs, Verdict::not_decidable, Verdict::no_data})
        text +=
            fmt::format("{}{}: {}", text.empty() ? "" : ", ", claims::name_of(verdict),
                        std::count_if(judged.begin(), judged.end(), [&](const JudgedClaim& row) {
                            return row.verdict == verdict;
                        }));
    return text;
}

nlohmann::json json_of(const JudgedClaim& row, const MeasuredSetups& measured) {
    const claims::Claim& claim = *row.claim;
    return {{"claim", claim.id},
            {"source", claim.source},
            {"says", claim.says},
            {"setup", claim.measured.setup},
            {"number", claim.measured.number},
            {"unit", claim.unit.empty() ? "1" : claim.unit},
            {"paper", claim.paper.text()},
            {"tolerance", claim.tolerance},
            {"tolerance_factor", claim.tolerance_factor},
            {"written", claims::name_of(claim.written)},
            {"mean", number_or_null(row.value.mean)},
            {"standard_error", number_or_null(row.value.standard_error)},
            {"seeds", row.value.n},
            {"ends", claims::ends_text(claim, measured)},
            {"verdict", claims::name_of(row.verdict)},
            {"reason", row.reason},
            {"remark", claim.remark},
            {"command", claims::command_of(claim)}};
}

/// claims.csv, claims.md, numbers.csv, runs.csv; returns their names.
std::vector<std::string>
write_files(const std::string& folder, const std::vector<JudgedClaim>& judged,
            const MeasuredSetups& measured, const std::vector<std::string>& remarks,
            const ReproduceArguments& arguments, const Invocation& invocation) {
    std::vector<std::string> comments = report_comments(invocation, arguments.common.n_threads());
    comments.insert(comments.end(), remarks.begin(), remarks.end());
    std::string list;
    for (const std::string& comment : comments) list += "* " + comment + "\n";
    const std::vector<std::string> files{folder + "/claims.csv", folder + "/claims.md",
                                         folder + "/numbers.csv", folder + "/runs.csv"};
    write_text_file(files[0], claims::claims_report(judged, measured).csv_text(comments));
    write_text_file(files[1], claims::claims_markdown(judged, measured) + "\n" + list);
    write_text_file(files[2], claims::numbers_report(measured).csv_text(comments));
    write_text_file(files[3], claims::runs_report(measured).csv_text(comments));
    return files;
}

ExitCode reproduce(const ReproduceArguments& arguments, const Invocation& invocation) {
    if (arguments.common.quiet) make_log_quiet();
    const Extent extent = extent_of(arguments);
    const ClaimTable table = claims::load_claims(arguments.claims);
    check_only(table, arguments.only);
    // A mistake in a scene is found before hours of runs.
    for (const ClaimedSetup& setup : table.setups)
        if (setup.beads == 0) static_cast<void>(scene_of(table, setup, setup.seeds.front()));
    constexpr auto k_standard_folder = "out/reproduce";
    if (arguments.stored && arguments.keep.empty())
        check_is_there(arguments.common.output.empty() ? k_standard_folder
                                                       : arguments.common.output);
    const std::string folder = report_folder(arguments.common, k_standard_folder);

    MeasuredSetups measured;
    for (const ClaimedSetup& setup : table.setups)
        if (is_wanted(setup, arguments) && interrupt_signal() == 0) {
            MeasuredSetup one =
                measure_setup(table, setup, folder, extent, arguments.common, invocation);
            if (!one.runs.empty() || !one.troubles.empty()) measured[setup.name] = std::move(one);
        }
    if (!arguments.keep.empty()) add_kept(table, arguments.keep, measured);
    const std::vector<JudgedClaim> judged = claims::judge_claims(table, measured);
    const std::vector<std::string> remarks = remarks_on(measured);
    const std::vector<std::string> files =
        write_files(folder, judged, measured, remarks, arguments, invocation);
    if (arguments.common.json) {
        nlohmann::json rows = nlohmann::json::array();
        for (const JudgedClaim& row : judged) rows.push_back(json_of(row, measured));
        print_json({{"claims", rows}, {"remarks", remarks}, {"files", files}});
    } else {
        fmt::print("{}\n", claims::claims_report(judged, measured).aligned_text());
        for (const JudgedClaim& row : judged)
            if (!row.reason.empty()) fmt::print("{}: {}\n", row.claim->id, row.reason);
        for (const std::string& remark : remarks) fmt::print("{}\n", remark);
        fmt::print("{}\n", verdicts_text(judged));
        for (const std::string& file : files) fmt::print("written to {}\n", file);
    }
    const bool has_failures = std::any_of(measured.begin(), measured.end(), [](const auto& setup) {
        return !setup.second.troubles.empty();
    });
    return code_after_signal(has_failures ? ExitCode::not_converged : ExitCode::ok);
}

}  // namespace

Verb reproduce_verb() {
    return {"reproduce",
            "the paper's claims one by one: what it says, what the runs give, verdict; makes the "
            "runs that are missing",
            [](CommandLine& command) -> VerbAction {
                const auto arguments = std::make_shared<ReproduceArguments>();
                command.optional_argument("CLAIMS", arguments->claims,
                                          "file of claims; default: the paper's");
                command.flag("--quick", arguments->quick,
                             "some seeds of some setups: five minutes on two cores");
                command.flag("--full", arguments->full, "all seeds of all setups: hours");
                command.flag("--stored", arguments->stored,
                             "judge the runs that are in the folder, make none");
                command.option("--only", arguments->only,
                               "this setup only; may be given several times");
                command.option(
                    "--keep", arguments->keep,
                    "folder of an earlier report: setups without runs here are judged by "
                    "its numbers");
                add_common_options(command, arguments->common,
                                   {CommonOption::output_folder, CommonOption::threads,
                                    CommonOption::simd, CommonOption::json, CommonOption::quiet});
                return [arguments](const Invocation& invocation) {
                    return reproduce(*arguments, invocation);
                };
            }};
}

}  // namespace spheroscope::cli
