#include "render/verb_pictures.hpp"

#include <fmt/format.h>

#include <filesystem>

namespace spheroscope {

bool is_run_file(const std::string& path) {
    return std::filesystem::path(path).extension() == ".h5";
}

namespace {

/// A run that is there was simulated with its own values: only how it is drawn can change.
void check_is_of_pictures(const std::string& file, const cli::CommonOptions& options) {
    for (const scene::Override& change : options.overrides())
        if (!change.key.starts_with("picture["))
            throw Error(change.key == "scene.seed"
                            ? file + ": --seed means nothing to a run that is there"
                            : file + ": --set " + change.key +
                                  " means nothing to a run that is there",
                        "keys of its pictures can be changed; `movie SCENE` simulates anew");
}

}  // namespace

std::vector<scene::Picture> pictures_of(const RunFileReader& reader,
                                        const cli::CommonOptions& options) {
    check_is_of_pictures(reader.path(), options);
    const scene::Scene scene = scene::parse_scene(reader.header()->resolved_scene,
                                                  "scene in " + reader.path(), options.overrides());
    const std::vector<const Field*>& fields = reader.header()->fields;
    if (scene.pictures.empty())
        throw Error(reader.path() + ": its scene has no [[picture]]",
                    fmt::format("add one with --set 'picture[0].field={}'",
                                fields.empty() ? "" : fields.front()->name));
    return scene.pictures;
}

std::vector<scene::Picture> choose(const std::vector<scene::Picture>& pictures,
                                   const std::string& wanted) {
    if (wanted == "all") return pictures;
    if (wanted.empty()) return {pictures.front()};
    std::string known;
    for (const scene::Picture& picture : pictures) {
        if (picture.name == wanted) return {picture};
        known += " " + picture.name;
    }
    throw Error("there is no picture '" + wanted + "'", "pictures are:" + known + " all");
}

}  // namespace spheroscope
