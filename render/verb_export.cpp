#include "engine/cli/frame_choice.hpp"
#include "engine/cli/json_output.hpp"
#include "engine/cli/options.hpp"
#include "engine/cli/report_output.hpp"
#include "engine/store/atomic_file.hpp"
#include "engine/store/run_file.hpp"
#include "engine/store/xdmf.hpp"
#include "render/export_vtk.hpp"
#include "render/verbs.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace spheroscope {
namespace {

namespace fs = std::filesystem;

struct ExportArguments {
    std::string file;
    std::optional<int> frame;
    cli::CommonOptions common;
};

void write_text(const fs::path& path, const std::string& text) {
    AtomicFile file(path.string(), AtomicFile::Mode::create);
    file.write(0, std::as_bytes(std::span(text)));
    file.commit();
}

ExitCode export_run(const ExportArguments& arguments) {
    const RunFileReader reader(arguments.file);
    const int last = cli::FrameChoice{arguments.frame, ""}.number(reader);
    const int first = arguments.frame ? last : 0;
    const fs::path folder =
        cli::report_folder(arguments.common, fs::path(arguments.file).parent_path() / "paraview");
    std::vector<render::DatedFile> surfaces, network;
    for (int i = first; i <= last; ++i) {
        const SnapshotPtr frame = reader.frame(i);
        surfaces.push_back({fmt::format("cells_{:06d}.vtp", i), frame->time_s});
        network.push_back({fmt::format("network_{:06d}.vtp", i), frame->time_s});
        write_text(folder / surfaces.back().name, render::surfaces_vtp(*frame));
        write_text(folder / network.back().name, render::network_vtp(*frame));
    }
    // last: a collection never names a file that is not there
    const fs::path cells_pvd = folder / "cells.pvd", network_pvd = folder / "network.pvd";
    write_text(cells_pvd, render::pvd_text(surfaces));
    write_text(network_pvd, render::pvd_text(network));
    // The run's own description for ParaView may have been left behind by a copy of the file.
    if (!fs::exists(xdmf_path(reader.path()))) write_xdmf(reader);
    if (arguments.common.json)
        cli::print_json({{"cells", cells_pvd.string()},
                         {"network", network_pvd.string()},
                         {"xdmf", xdmf_path(reader.path())},
                         {"frames", last - first + 1}});
    else
        fmt::print("cells    {}\nnetwork  {}\nxdmf     {}\nframes   {}\n", cells_pvd.string(),
                   network_pvd.string(), xdmf_path(reader.path()), last - first + 1);
    return ExitCode::ok;
}

}  // namespace

cli::Verb export_verb() {
    return {"export", "writes a run's file for ParaView: .vtp for each frame, and .pvd",
            [](cli::CommandLine& command) -> cli::VerbAction {
                using cli::CommonOption;
                const auto arguments = std::make_shared<ExportArguments>();
                command.argument("FILE", arguments->file, "HDF5 file of a run");
                command.option("--frame", arguments->frame,
                               "this frame only; -1 is the last (default: all)");
                cli::add_common_options(command, arguments->common,
                                        {CommonOption::output_folder, CommonOption::json});
                return [arguments](const cli::Invocation&) { return export_run(*arguments); };
            }};
}

}  // namespace spheroscope
