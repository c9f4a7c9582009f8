#include "engine/scene/same_run.hpp"

#include "engine/base/error.hpp"
#include "engine/scene/scene.hpp"

#include <string_view>

namespace spheroscope::scene {
namespace {

std::string_view without_pictures(std::string_view resolved_toml) {
    const std::string_view kept = resolved_toml.substr(0, resolved_toml.find("[[picture]]"));
    return kept.substr(0, kept.find_last_not_of('\n') + 1);  // an empty line is before the tables
}

}  // namespace

bool is_same_run(const std::string& stored_toml, const std::string& wanted_toml) {
    const std::string_view wanted = without_pictures(wanted_toml);
    if (without_pictures(stored_toml) == wanted) return true;
    try {
        // An earlier version did not write keys that have come since; read anew, they have their
        // defaults.
        return without_pictures(parse_scene(stored_toml, "stored").resolved_toml) == wanted;
    } catch (const Error&) {
        return false;  // a scene that this version does not take is another one
    }
}

}  // namespace spheroscope::scene
