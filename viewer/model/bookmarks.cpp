#include "viewer/model/bookmarks.hpp"

#include "engine/base/error.hpp"
#include "engine/base/whole_file.hpp"
#include "engine/scene/picture_fields.hpp"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>

namespace spheroscope::viewer {
namespace {

nlohmann::json json_of(const Bookmark& bookmark) {
    const scene::Picture& p = bookmark.view.picture;
    nlohmann::json json{{"name", bookmark.name},
                        {"frame", bookmark.frame},
                        {"picture", p.name},
                        {"fps", p.fps},
                        {"shots", p.shots}};
    scene::visit_shown(p, [&](const char* key, const auto& value) { json[key] = value; });
    return json;
}

Bookmark bookmark_of(const nlohmann::json& stored) {
    // Not in bookmarks of before these were there.
    nlohmann::json json{{"stress_axes", false}, {"exploded", 0.0}};
    json.update(stored);
    Bookmark bookmark;
    bookmark.name = json.at("name");
    bookmark.frame = json.at("frame");
    scene::Picture& p = bookmark.view.picture;
    p.name = json.at("picture");
    p.fps = json.at("fps");
    p.shots = json.at("shots");
    scene::visit_shown(p, [&](const char* key, auto& value) { json.at(key).get_to(value); });
    return bookmark;
}

}  // namespace

std::vector<Bookmark> read_bookmarks(const std::string& path) {
    if (!std::filesystem::exists(path)) return {};
    std::ifstream file(path);
    try {
        const nlohmann::json document = nlohmann::json::parse(file);
        std::vector<Bookmark> bookmarks;
        for (const nlohmann::json& item : document.at("bookmarks"))
            bookmarks.push_back(bookmark_of(item));
        return bookmarks;
    } catch (const nlohmann::json::exception& error) {
        throw Error(Loc{path, 0, 0}, std::string("these are no bookmarks of ours: ") + error.what(),
                    "move the file away to begin anew");
    }
}

void write_bookmarks(const std::string& path, const std::vector<Bookmark>& bookmarks) {
    nlohmann::json items = nlohmann::json::array();
    for (const Bookmark& bookmark : bookmarks) items.push_back(json_of(bookmark));
    WholeFile whole(path);
    std::ofstream file(whole.working_path());
    file << nlohmann::json{{"bookmarks", items}}.dump(1) << "\n";
    file.close();
    if (!file || whole.publish())
        throw Error(Loc{path, 0, 0}, "the bookmarks cannot be written", "is the folder writable?",
                    ExitCode::environment);
}

std::string bookmarks_path(const std::string& run_file) {
    return std::filesystem::path(run_file).replace_extension(".bookmarks.json").string();
}

}  // namespace spheroscope::viewer
