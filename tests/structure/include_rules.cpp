#include "tests/structure/include_rules.hpp"

#include <algorithm>
#include <map>
#include <regex>
#include <set>
#include <sstream>

// The dependency rule, one direction:
//
//     base <- scene
//     base <- model <- contact <- forces, friction <- solve, measures <- stages <- run <- store,
//     reports, inspect <- cli
//     inspect <- statistics <- claims <- cli
//
// Pictures see what a run publishes (model, measures, run, store, scene) and the command line for
// their verbs, never how the engine computes it. The panel sees the same and the pictures; its
// model (viewer/model) sees the engine's part of it and nothing that draws.
namespace spheroscope::structure {
namespace {

/// Folder -> the folders of engine/ that it may include; itself is always allowed.
const std::map<std::string, std::set<std::string>>& allowed_folders() {
    static const std::set<std::string> terms{"base", "model", "contact", "forces", "friction"};
    static const std::set<std::string> staged{"base",     "model", "contact", "forces",
                                              "friction", "solve", "scene",   "measures"};
    static const auto with = [](std::set<std::string> set, const std::set<std::string>& more) {
        set.insert(more.begin(), more.end());
        return set;
    };
    static const std::map<std::string, std::set<std::string>> table{
        {"engine/base", {}},
        {"engine/scene", {"base"}},
        {"engine/model", {"base"}},
        {"engine/contact", {"base", "model"}},
        {"engine/forces", {"base", "model", "contact"}},
        {"engine/friction", {"base", "model", "contact"}},
        {"engine/solve", terms},
        {"engine/measures", terms},
        {"engine/stages", staged},
        {"engine/run", with(staged, {"stages"})},
        {"engine/store", with(staged, {"stages", "run"})},
        {"engine/reports", with(staged, {"stages", "run"})},
        {"engine/inspect", with(staged, {"stages", "run"})},
        {"engine/statistics", with(staged, {"stages", "run", "inspect"})},
        {"engine/claims", {"base", "scene", "reports", "statistics"}},
        {"engine/cli",
         with(staged, {"stages", "run", "store", "reports", "inspect", "statistics", "claims"})},
        {"render",
         {"base", "model", "scene", "measures", "run", "store", "reports", "inspect", "statistics",
          "cli"}},
        {"viewer/model", {"base", "model", "scene", "measures", "run", "inspect", "statistics"}},
        {"viewer", {"base", "model", "scene", "measures", "run", "inspect", "store", "cli"}},
    };
    return table;
}

const std::regex k_display_library(R"(vtk.*|VTK.*|GL/.*|GLFW/.*|GLES.*|EGL/.*|imgui.*|ImGui.*)");
const std::regex k_heavy_library(R"(hdf5\.h|H5.*|toml.*)");
const std::set<std::string> k_light_headers{"engine/model",   "engine/forces", "engine/friction",
                                            "engine/contact", "engine/solve",  "engine/measures"};

/// "engine/forces" of "engine/forces/bending.hpp"; "render" of everything below render/; "viewer"
/// of everything below viewer/ but viewer/model.
std::string folder_of(const std::string& path) {
    if (path.rfind("viewer/model/", 0) == 0) return "viewer/model";
    const std::size_t first = path.find('/');
    const std::string top = path.substr(0, first);
    if (top != "engine" || first == std::string::npos) return top;
    const std::size_t second = path.find('/', first + 1);
    return second == std::string::npos ? top : path.substr(0, second);
}

bool is_header(const std::string& path) {
    return path.size() > 4 && path.compare(path.size() - 4, 4, ".hpp") == 0;
}

/// Why `path`, in `folder`, may not include `header`; "" when it may.
std::string objection(const std::string& path, const std::string& folder,
                      const std::string& header) {
    const bool may_draw = folder == "render" || folder == "viewer";
    const std::string target = folder_of(header);
    if (target == "render" || target == "viewer" || target == "viewer/model") {
        // the program is where all verbs meet
        if (path == "engine/cli/main.cpp" &&
            (header == "render/verbs.hpp" || header == "render/inspect_drawers.hpp" ||
             header == "render/probe.hpp" || header == "viewer/verbs.hpp"))
            return "";
        const bool allowed = target == folder || folder == "viewer";
        return allowed ? "" : folder + " may not include " + target;
    }
    if (target.rfind("engine/", 0) == 0) {
        const std::string name = target.substr(std::string("engine/").size());
        const bool allowed = target == folder || allowed_folders().at(folder).count(name) > 0;
        return allowed ? "" : folder + " may not include " + target;
    }
    if (!may_draw && std::regex_match(header, k_display_library))
        return folder + " may not include what draws";
    if (is_header(path) && k_light_headers.count(folder) > 0 &&
        std::regex_match(header, k_heavy_library))
        return "headers of " + folder + " may not include libraries for files";
    return "";
}

}  // namespace

std::vector<Violation> find_violations(const std::string& path, const std::string& text) {
    const std::string folder = folder_of(path);
    const bool is_ours = path.rfind("engine/", 0) == 0 || path.rfind("render/", 0) == 0 ||
                         path.rfind("viewer/", 0) == 0;
    if (!is_ours) return {};
    if (allowed_folders().count(folder) == 0)
        return {path + ": the dependency rule has no row for " + folder};

    static const std::regex include(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"].*)");
    std::vector<Violation> violations;
    std::istringstream lines(text);
    std::string line;
    std::smatch match;
    for (int number = 1; std::getline(lines, line); ++number) {
        if (!std::regex_match(line, match, include)) continue;
        const std::string header = match[1];
        const std::string reason = objection(path, folder, header);
        if (!reason.empty())
            violations.push_back(path + ":" + std::to_string(number) + ": " + reason + " (" +
                                 header + ")");
    }
    return violations;
}

}  // namespace spheroscope::structure
