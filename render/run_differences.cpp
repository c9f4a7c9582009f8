#include "render/run_differences.hpp"

#include "engine/base/error.hpp"
#include "engine/run/changes.hpp"
#include "engine/scene/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <sstream>
#include <string_view>

namespace spheroscope::render {

namespace {

/// One thing that may differ: a part of the scene, one of its keys, or what is no part of it.
struct Setting {
    std::string part;  ///< of which it is a key; empty: of none
    std::string name, shown, absent;
};

/// Nothing in them moves a cell.
bool is_of_the_motion(std::string_view table) {
    constexpr std::array<std::string_view, 4> others{"picture", "expect", "stability", "variant"};
    return std::none_of(others.begin(), others.end(),
                        [&](std::string_view other) { return table.starts_with(other); });
}

/// An earlier version did not write keys that have come since; read anew, they have their defaults.
std::string scene_text(const RunHeader& header) {
    try {
        return scene::parse_scene(header.resolved_scene, header.scene_name).resolved_toml;
    } catch (const Error&) {
        return header.resolved_scene;
    }
}

void add_settings_of_scene(const RunHeader& header, std::vector<Setting>& settings) {
    std::istringstream lines(scene_text(header));
    std::map<std::string, int> n_seen;  // of lists of tables
    std::string line, table;
    while (std::getline(lines, line)) {
        if (line.starts_with('[')) {
            const std::size_t n_brackets = line.starts_with("[[") ? 2 : 1;
            table = line.substr(n_brackets, line.size() - 2 * n_brackets);
            if (n_brackets == 2) table += fmt::format("[{}]", n_seen[table]++);
            if (is_of_the_motion(table))
                settings.push_back({"", table, "[" + table + "]", "without [" + table + "]"});
            continue;
        }
        const std::size_t equals = line.find(" = ");
        if (equals == std::string::npos || !is_of_the_motion(table)) continue;
        const std::string key = line.substr(0, equals);
        std::string value = line.substr(equals + 3);
        // Fields that are stored follow from the pictures.
        if ((table == "scene" && key == "title") || (table == "measures" && key == "fields"))
            continue;
        if (value.size() > 1 && value.front() == '"') value = value.substr(1, value.size() - 2);
        const std::string name = table == "scene" ? key : table + "." + key;
        settings.push_back({table, name, name + " = " + value, "without " + name});
    }
}

std::vector<Setting> settings_of(const Snapshot& last) {
    std::vector<Setting> settings;
    add_settings_of_scene(*last.header, settings);
    std::string changes;
    if (last.changes)
        for (const Change& change : *last.changes) {
            const ChangeableRow& row = *find_changeable(change.key);
            if (row.of == ChangeableRow::Of::engine)
                changes += fmt::format(
                    "{}{} = {} from {:g} s", changes.empty() ? "" : ", ", change.key,
                    scene::format_quantity(change.values[0], row.dimension), change.time_s);
        }
    if (changes.empty()) changes = "not changed on its way";
    settings.push_back({"", "changes on the way", changes, ""});
    settings.push_back({"", "version", "version " + last.header->version, ""});
    return settings;
}

const Setting* find(const std::vector<Setting>& settings, const std::string& name) {
    const auto found = std::find_if(settings.begin(), settings.end(),
                                    [&](const Setting& s) { return s.name == name; });
    return found == settings.end() ? nullptr : &*found;
}

}  // namespace

std::vector<std::string> what_differs(std::span<const SnapshotPtr> last_frames) {
    std::vector<std::vector<Setting>> runs;
    for (const SnapshotPtr& last : last_frames) runs.push_back(settings_of(*last));
    const auto all_have = [&](const std::string& part) {
        return std::all_of(runs.begin(), runs.end(),
                           [&](const auto& settings) { return find(settings, part) != nullptr; });
    };
    std::vector<Setting> all;  // of any run, each once
    for (const std::vector<Setting>& settings : runs)
        for (const Setting& setting : settings)
            if (find(all, setting.name) == nullptr) all.push_back(setting);
    std::vector<std::string> marks(runs.size());
    for (const Setting& setting : all) {
        // A part that is not there has no keys either: saying so once is enough.
        if (!setting.part.empty() && !all_have(setting.part)) continue;
        std::vector<std::string> texts;
        for (const std::vector<Setting>& settings : runs) {
            const Setting* const own = find(settings, setting.name);
            texts.push_back(own != nullptr ? own->shown : setting.absent);
        }
        if (std::count(texts.begin(), texts.end(), texts.front()) ==
            static_cast<std::ptrdiff_t>(texts.size()))
            continue;
        for (std::size_t k = 0; k < runs.size(); ++k)
            marks[k] += (marks[k].empty() ? "" : ", ") + texts[k];
    }
    return marks;
}

}  // namespace spheroscope::render
