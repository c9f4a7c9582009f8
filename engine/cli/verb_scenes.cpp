#include "engine/cli/json_output.hpp"
#include "engine/cli/log.hpp"
#include "engine/cli/options.hpp"
#include "engine/cli/verb.hpp"
#include "engine/scene/scene.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <system_error>
#include <vector>

namespace spheroscope::cli {
namespace {

struct ScenesArguments {
    std::string folder = SPHEROSCOPE_SCENES_DIR;
    CommonOptions common;
};

/// One scene file of the list: its title, or why it cannot be loaded.
struct Entry {
    std::string file;
    std::string title;
    std::string error;
};

/// The path as one would type it here: relative where that is not longer.
std::string shown_path(const std::filesystem::path& path) {
    std::error_code failed;
    const std::string relative = std::filesystem::relative(path, failed).string();
    const std::string absolute = path.string();
    return failed || relative.empty() || relative.size() > absolute.size() ? absolute : relative;
}

Entry read_entry(const std::filesystem::path& path) {
    Entry entry{shown_path(path), "", ""};
    try {
        entry.title = scene::load_scene(entry.file).title;
    } catch (const Error& error) {
        entry.error = error.what();
    }
    return entry;
}

std::vector<Entry> read_entries(const std::string& folder) {
    std::error_code failed;
    std::vector<std::filesystem::path> files;
    // iterate by hand: a folder that cannot be read is an error of its own, not an empty list
    std::filesystem::recursive_directory_iterator item(folder, failed);
    for (; !failed && item != std::filesystem::recursive_directory_iterator();
         item.increment(failed))
        if (item->path().extension() == ".toml") files.push_back(item->path());
    if (failed)
        throw Error(
            fmt::format("wanted a folder with scenes, got '{}' ({})", folder, failed.message()));
    std::sort(files.begin(), files.end());
    std::vector<Entry> entries;
    for (const std::filesystem::path& file : files) entries.push_back(read_entry(file));
    return entries;
}

void print_list(const std::vector<Entry>& entries) {
    nlohmann::json list = nlohmann::json::array();
    for (const Entry& entry : entries) {
        nlohmann::json row = {{"file", entry.file}, {"title", entry.title}};
        if (!entry.error.empty()) row["error"] = entry.error;
        list.push_back(row);
    }
    print_json({{"scenes", list}});
}

void print_table(const std::vector<Entry>& entries) {
    std::size_t width = 0;
    for (const Entry& entry : entries) width = std::max(width, entry.file.size());
    for (const Entry& entry : entries)
        fmt::print("{:<{}}  {}\n", entry.file, width,
                   entry.error.empty() ? entry.title : "(does not load)");
}

ExitCode list_scenes(const ScenesArguments& arguments) {
    const std::vector<Entry> entries = read_entries(arguments.folder);
    if (arguments.common.json)
        print_list(entries);
    else
        print_table(entries);
    ExitCode code = ExitCode::ok;
    for (const Entry& entry : entries) {
        if (entry.error.empty()) continue;
        print_error(entry.error);
        code = ExitCode::usage;
    }
    return code;
}

}  // namespace

Verb scenes_verb() {
    return {"scenes", "lists scene files with their titles",
            [](CommandLine& command) -> VerbAction {
                const auto arguments = std::make_shared<ScenesArguments>();
                command.optional_argument(
                    "FOLDER", arguments->folder,
                    "where to look (default: the scenes that come with the program)");
                add_common_options(command, arguments->common, {CommonOption::json});
                return [arguments](const Invocation&) { return list_scenes(*arguments); };
            }};
}

}  // namespace spheroscope::cli
