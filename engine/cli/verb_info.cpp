#include "engine/base/counted.hpp"
#include "engine/cli/accuracy_text.hpp"
#include "engine/cli/json_output.hpp"
#include "engine/cli/options.hpp"
#include "engine/cli/progress.hpp"
#include "engine/cli/report_output.hpp"
#include "engine/cli/seed_means_text.hpp"
#include "engine/cli/totals_text.hpp"
#include "engine/cli/verb.hpp"
#include "engine/statistics/motion_at_end.hpp"
#include "engine/statistics/setup.hpp"
#include "engine/store/run_file.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

namespace spheroscope::cli {
namespace {

struct InfoArguments {
    std::vector<std::string> files;
    CommonOptions common;
};

nlohmann::json describe(const RunFileReader& reader, const SnapshotPtr& last) {
    const RunHeader& header = *reader.header();
    nlohmann::json document{{"file", reader.path()},
                            {"title", header.title},
                            {"scene", header.scene_name},
                            {"seed", header.seed},
                            {"version", header.version},
                            {"command_line", header.command_line},
                            {"contact_arithmetic", header.contact_arithmetic},
                            {"cells", header.n_cells},
                            {"nodes_per_cell", header.topology->n_nodes()},
                            {"frames", reader.n_frames()},
                            {"complete", reader.is_complete()},
                            {"outcome", reader.outcome()},
                            {"wall_s", reader.end().wall_time_s},
                            {"errors", accuracy_json(reader.end().errors)}};
    if (!reader.changes().empty()) document["changes"] = changes_text(reader.changes());
    if (last) {
        document["time_s"] = last->time_s;
        document["steps"] = last->diagnostics.steps;
        document["rejected_steps"] = last->diagnostics.rejected_steps;
        document["linear_iterations"] = last->diagnostics.linear_iterations;
        document["totals"] = totals_json(last->totals);
        document["not_resolved"] = not_resolved_json(reader.end().errors);
    }
    return document;
}

/// Of changes_text; "" where nothing was changed.
std::string changes_in_words(const std::string& changes) {
    std::string text;
    if (!changes.empty()) text += "changed on the way   (s, key, value in um, s, nN)\n";
    std::istringstream lines(changes);
    for (std::string line; std::getline(lines, line);) text += "  " + line + "\n";
    return text;
}

std::string describe_in_words(const RunFileReader& reader, const SnapshotPtr& last) {
    const RunHeader& header = *reader.header();
    std::string text = fmt::format(
        "{}\nscene                {}, seed {}\nversion              {}\ncells                {} of "
        "{} nodes\nframes               {}\noutcome              {}\n",
        header.title, header.scene_name, header.seed, header.version, header.n_cells,
        header.topology->n_nodes(), reader.n_frames(),
        reader.outcome().empty() ? "not ended" : reader.outcome());
    if (!header.contact_arithmetic.empty())
        text += fmt::format("contact kernel       {}\n", header.contact_arithmetic);
    if (reader.end().wall_time_s > 0.0)
        text += fmt::format("wall time            {}\n", duration_text(reader.end().wall_time_s));
    text += changes_in_words(changes_text(reader.changes()));
    if (!last) return text;
    text += fmt::format("last frame           t = {:.4g} s, {}\nsteps                {} ({} "
                        "rejected), {}\n",
                        last->time_s, last->stage_name, last->diagnostics.steps,
                        last->diagnostics.rejected_steps,
                        counted(last->diagnostics.linear_iterations, "linear iteration"));
    return text + totals_text(last->totals, reader.end().errors) +
           accuracy_text(reader.end().errors, reader.end().wall_time_s);
}

ExitCode info_of_one(const InfoArguments& arguments) {
    const RunFileReader reader(arguments.files.front());
    const SnapshotPtr last =
        reader.n_frames() > 0 ? reader.frame(reader.n_frames() - 1) : SnapshotPtr();
    if (arguments.common.json)
        print_json(describe(reader, last));
    else
        fmt::print("{}", describe_in_words(reader, last));
    return ExitCode::ok;
}

/// Runs of one setup: the same scene but for the seed.
struct Replicates {
    statistics::Setup setup;
    std::vector<std::string> files{}, outcomes{};
    std::vector<std::uint64_t> seeds{};
    std::vector<Totals> totals{};
    std::vector<std::vector<MeasureError>> errors{};  // as the runs estimate them

    [[nodiscard]] bool has_seed(std::uint64_t seed) const {
        return std::find(seeds.begin(), seeds.end(), seed) != seeds.end();
    }
    /// "" where all runs are as slow as at rest.
    [[nodiscard]] std::string remark_on_motion() const {
        std::vector<statistics::MotionAtEnd> ends;
        for (std::size_t i = 0; i < seeds.size(); ++i)
            ends.push_back({seeds[i], outcomes[i], totals[i].normal_speed_rms_um_per_s});
        return statistics::remark_on_motion(ends);
    }
    [[nodiscard]] std::vector<std::string> remarks() const {
        std::vector<std::string> all = remarks_on_resolution(seeds, errors);
        if (std::string motion = remark_on_motion(); !motion.empty())
            all.insert(all.begin(), std::move(motion));
        return all;
    }
};

std::vector<Replicates> read_replicates(const std::vector<std::string>& files) {
    std::vector<Replicates> all;
    for (const std::string& file : files) {
        const RunFileReader reader(file);
        if (reader.n_frames() == 0)
            throw Error(file + ": the run has no frames yet", "leave it out of the means");
        const statistics::Setup setup = statistics::setup_of(*reader.header(), reader.changes());
        auto at = std::find_if(all.begin(), all.end(), [&](const Replicates& r) {
            return r.setup.scene_without_seed == setup.scene_without_seed;
        });
        if (at == all.end()) at = all.insert(all.end(), Replicates{.setup = setup});
        if (at->has_seed(reader.header()->seed))
            throw Error(fmt::format("{}: seed {} of this scene is there twice", file,
                                    reader.header()->seed),
                        "means are over different seeds");
        at->files.push_back(file);
        at->seeds.push_back(reader.header()->seed);
        at->outcomes.push_back(reader.outcome().empty() ? "not ended" : reader.outcome());
        at->totals.push_back(reader.frame(reader.n_frames() - 1)->totals);
        at->errors.push_back(reader.end().errors);
    }
    return all;
}

/// Means over seeds, setup by setup.
ExitCode info_of_several(const InfoArguments& arguments) {
    nlohmann::json document = nlohmann::json::array();
    std::string text;
    for (const Replicates& replicates : read_replicates(arguments.files)) {
        const std::vector<std::string> remarks = replicates.remarks();
        document.push_back({{"title", replicates.setup.title},
                            {"gamma_over_omega", number_or_null(replicates.setup.gamma_over_omega)},
                            {"Et_over_omega", number_or_null(replicates.setup.Et_over_omega)},
                            {"cells", replicates.setup.n_cells},
                            {"nodes_per_cell", replicates.setup.n_nodes},
                            {"files", replicates.files},
                            {"seeds", replicates.seeds},
                            {"outcomes", replicates.outcomes},
                            {"changes", replicates.setup.changes},
                            {"remarks", remarks},
                            {"totals", seed_means_json(replicates.totals)}});
        text += fmt::format("{}{}\ngamma/omega          {}\nEt/omega             {}\n"
                            "cells                {} of {} nodes\n",
                            text.empty() ? "" : "\n", replicates.setup.title,
                            statistics::ratio_text(replicates.setup.gamma_over_omega),
                            statistics::ratio_text(replicates.setup.Et_over_omega),
                            replicates.setup.n_cells, replicates.setup.n_nodes);
        text += changes_in_words(replicates.setup.changes);
        for (std::size_t i = 0; i < replicates.files.size(); ++i)
            text += fmt::format("seed {:<15} {}, {}\n", replicates.seeds[i], replicates.outcomes[i],
                                replicates.files[i]);
        for (const std::string& remark : remarks) text += remark + "\n";
        text += seed_means_text(replicates.totals);
    }
    if (arguments.common.json)
        print_json({{"setups", document}});
    else
        fmt::print("{}", text);
    return ExitCode::ok;
}

ExitCode info(const InfoArguments& arguments) {
    if (arguments.files.empty()) throw Error("FILE is required", "info out/first_light/run.h5");
    return arguments.files.size() == 1 ? info_of_one(arguments) : info_of_several(arguments);
}

}  // namespace

Verb info_verb() {
    return {"info", "says what is in the file of a run; of several, the means over seeds",
            [](CommandLine& command) -> VerbAction {
                const auto arguments = std::make_shared<InfoArguments>();
                command.optional_arguments("FILE", arguments->files,
                                           "HDF5 file of a run, or of several");
                add_common_options(command, arguments->common, {CommonOption::json});
                return [arguments](const Invocation&) { return info(*arguments); };
            }};
}

}  // namespace spheroscope::cli
