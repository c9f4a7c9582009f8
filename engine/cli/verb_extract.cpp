#include "engine/cli/verb_extract.hpp"

#include "engine/base/whole_file.hpp"
#include "engine/cli/frame_choice.hpp"
#include "engine/cli/json_output.hpp"
#include "engine/cli/log.hpp"
#include "engine/cli/options.hpp"
#include "engine/cli/report_output.hpp"
#include "engine/inspect/extract.hpp"
#include "engine/scene/time_text.hpp"
#include "engine/store/held_load_file.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <memory>

namespace spheroscope::cli {
namespace {

namespace fs = std::filesystem;

struct ExtractArguments {
    std::string file;
    std::string contact;
    std::string duration = "1 s";
    FrameChoice frame;
    bool overwrite = false;
    CommonOptions common;
};

ExitCode extract(const ExtractArguments& arguments) {
    if (arguments.common.quiet) make_log_quiet();
    if (arguments.contact.empty())
        throw Error("extract wants the contact that is taken out",
                    "name it with --contact 17-42; `inspect` lists them");
    const inspect::ContactKey key = inspect::parse_contact(arguments.contact);
    const double duration_s = scene::parse_span_s("--duration", arguments.duration, "2 s");
    const fs::path scene_path = arguments.common.output.empty()
                                    ? fs::path("contact_" + key.text() + ".toml")
                                    : fs::path(arguments.common.output);
    if (scene_path.extension() != ".toml")
        throw Error("-o wants the name of a scene (.toml), got '" + scene_path.string() + "'");
    const fs::path run_path = fs::path(scene_path).replace_extension(".h5");
    for (const fs::path& path : {scene_path, run_path})
        if (fs::exists(path) && !arguments.overwrite)
            throw Error(path.string() + ": this file is there already",
                        "--overwrite replaces it, -o writes elsewhere");

    refuse_own_input(run_path.string(), arguments.file);
    const RunFileReader reader(arguments.file);
    const SnapshotPtr frame = reader.frame(arguments.frame.number(reader));
    inspect::FrameSystem whole(reader.header(), {}, inspect::FrameSystem::Detail::forces);
    whole.load(frame);
    const inspect::ExtractedPair pair =
        inspect::extract_pair(whole, key, run_path.filename().string(), duration_s);
    // Both files or none: the cells get their name when they and the scene are written.
    WholeFile cells(run_path);
    const std::string working_path = cells.working_path().string();
    {
        RunFileWriter writer =
            RunFileWriter::create(working_path, *pair.header, RunFileWriter::Existing::replace);
        writer.write(pair.frame);
        writer.finish({true, "extracted"});
    }
    write_held_load(working_path, pair.load);
    write_text_file(scene_path.string(), pair.scene_toml);
    if (cells.publish())
        throw Error(run_path.string() + ": the file cannot be given its name",
                    "is the folder protected?", ExitCode::environment);

    const ContactLink& link = pair.frame.links.front();
    if (arguments.common.json)
        print_json({{"scene", scene_path.string()},
                    {"cells", run_path.string()},
                    {"contact", key.text()},
                    {"frame", frame->frame},
                    {"time_s", frame->time_s},
                    {"centre_force_nN", double{link.force_nN}},
                    {"area_um2", double{link.area_um2}}});
    else
        fmt::print("contact {}, frame {}, t = {:.6g} s: force along the centres {:.5g} nN, area "
                   "{:.5g} um^2\nwritten to {} (scene) and {} (cells and held forces)\n",
                   key.text(), frame->frame, frame->time_s, double{link.force_nN},
                   double{link.area_um2}, scene_path.string(), run_path.string());
    return ExitCode::ok;
}

}  // namespace

Verb extract_verb() {
    return {"extract", "makes a scene of one contact, its surroundings' forces held",
            [](CommandLine& command) -> VerbAction {
                const auto arguments = std::make_shared<ExtractArguments>();
                command.argument("FILE", arguments->file, "HDF5 file of a run");
                command.option("--contact", arguments->contact,
                               "the two cells, for instance 17-42; must be given", {"A-B"});
                add_frame_options(command, arguments->frame);
                command.option("--duration", arguments->duration,
                               "model time of the new scene (default: 1 s)", {"TIME"});
                command.flag("--overwrite", arguments->overwrite, "replace files that are there");
                add_common_options(command, arguments->common,
                                   {CommonOption::output, CommonOption::json, CommonOption::quiet});
                return [arguments](const Invocation&) { return extract(*arguments); };
            }};
}

}  // namespace spheroscope::cli
