#include "engine/scene/differences.hpp"

#include "engine/base/error.hpp"
#include "engine/scene/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <sstream>

namespace spheroscope::scene {
namespace {

/// Nothing in the others moves a cell.
bool is_of_the_motion(std::string_view table) {
    constexpr std::array<std::string_view, 4> others{"picture", "expect", "stability", "variant"};
    return std::none_of(others.begin(), others.end(),
                        [&](std::string_view other) { return table.starts_with(other); });
}

/// An earlier version did not write keys that have come since; read anew, they have their defaults.
std::string with_all_keys(const std::string& resolved_toml, const std::string& name) {
    try {
        return parse_scene(resolved_toml, name).resolved_toml;
    } catch (const Error&) {
        return resolved_toml;
    }
}

const Setting* find(const std::vector<Setting>& settings, const std::string& name) {
    const auto found = std::find_if(settings.begin(), settings.end(),
                                    [&](const Setting& s) { return s.name == name; });
    return found == settings.end() ? nullptr : &*found;
}

}  // namespace

std::vector<Setting> settings_of_motion(const std::string& resolved_toml, const std::string& name) {
    std::vector<Setting> settings;
    std::istringstream lines(with_all_keys(resolved_toml, name));
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
        const std::string full_name = table == "scene" ? key : table + "." + key;
        settings.push_back({table, full_name, full_name + " = " + value, "without " + full_name});
    }
    return settings;
}

std::vector<std::string> what_differs(std::span<const std::vector<Setting>> runs) {
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

}  // namespace spheroscope::scene
