#include "engine/cli/accuracy_text.hpp"
#include "engine/cli/json_output.hpp"
#include "engine/cli/options.hpp"
#include "engine/cli/progress.hpp"
#include "engine/cli/totals_text.hpp"
#include "engine/cli/verb.hpp"
#include "engine/store/run_file.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <memory>
#include <sstream>
#include <string>

namespace spheroscope::cli {
namespace {

struct InfoArguments {
    std::string file;
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
    }
    return document;
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
    if (!reader.changes().empty()) {
        text += "changed on the way   (s, key, value in um, s, nN)\n";
        std::istringstream lines(changes_text(reader.changes()));
        for (std::string line; std::getline(lines, line);) text += "  " + line + "\n";
    }
    if (!last) return text;
    text += fmt::format("last frame           t = {:.4g} s, {}\nsteps                {} ({} "
                        "rejected), {} linear iterations\n",
                        last->time_s, last->stage_name, last->diagnostics.steps,
                        last->diagnostics.rejected_steps, last->diagnostics.linear_iterations);
    return text + totals_text(last->totals) + accuracy_text(reader.end().errors);
}

ExitCode info(const InfoArguments& arguments) {
    const RunFileReader reader(arguments.file);
    const SnapshotPtr last =
        reader.n_frames() > 0 ? reader.frame(reader.n_frames() - 1) : SnapshotPtr();
    if (arguments.common.json)
        print_json(describe(reader, last));
    else
        fmt::print("{}", describe_in_words(reader, last));
    return ExitCode::ok;
}

}  // namespace

Verb info_verb() {
    return {"info", "says what is in the file of a run", [](CommandLine& command) -> VerbAction {
                const auto arguments = std::make_shared<InfoArguments>();
                command.argument("FILE", arguments->file, "HDF5 file of a run");
                add_common_options(command, arguments->common, {CommonOption::json});
                return [arguments](const Invocation&) { return info(*arguments); };
            }};
}

}  // namespace spheroscope::cli
