#include "render/run_differences.hpp"

#include "engine/run/changes.hpp"
#include "engine/scene/differences.hpp"

#include <fmt/format.h>

namespace spheroscope::render {
namespace {

std::vector<scene::Setting> settings_of(const Snapshot& last) {
    const RunHeader& header = *last.header;
    std::vector<scene::Setting> settings =
        scene::settings_of_motion(header.resolved_scene, header.scene_name);
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
    settings.push_back({"", "version", "version " + header.version, ""});
    return settings;
}

}  // namespace

std::vector<std::string> what_differs(std::span<const SnapshotPtr> last_frames) {
    std::vector<std::vector<scene::Setting>> runs;
    for (const SnapshotPtr& last : last_frames) runs.push_back(settings_of(*last));
    return scene::what_differs(runs);
}

}  // namespace spheroscope::render
