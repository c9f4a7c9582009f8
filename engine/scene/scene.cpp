#include "engine/scene/scene.hpp"

#include "engine/scene/document.hpp"
#include "engine/scene/reader.hpp"
#include "engine/scene/resolve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace spheroscope::scene {

Scene parse_scene(const std::string& text, const std::string& name,
                  const std::vector<Override>& overrides) {
    Document document = parse_document(text, name);
    for (const Override& override_ : overrides) {
        apply_override(document, override_);
        drop_alternatives(document, override_);
    }
    Draft draft = read_draft(document);
    resolve(draft);
    draft.scene.resolved_toml = canonical_text(draft);
    return std::move(draft.scene);
}

Scene on_mesh(const Scene& scene, int nodes) {
    Scene changed = scene;
    changed.cells.nodes = nodes;
    for (Stage& stage : changed.stages)
        stage.nodes = stage.nodes == scene.cells.nodes ? nodes : std::min(stage.nodes, nodes);
    return changed;
}

Scene load_scene(const std::string& path, const std::vector<Override>& overrides) {
    const Loc loc{path, 0, 0};
    std::error_code unknown;  // then opening it says what is wrong
    if (std::filesystem::is_directory(path, unknown))
        throw Error(loc, "this is a directory, wanted a scene file (*.toml)");
    std::ifstream file(path, std::ios::binary);
    if (!file) throw Error(loc, fmt::format("cannot open the scene: {}", std::strerror(errno)));
    const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    if (file.bad())
        throw Error(loc, fmt::format("cannot read the scene: {}", std::strerror(errno)));
    return parse_scene(text, path, overrides);
}

}  // namespace spheroscope::scene
