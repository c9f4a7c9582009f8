#include "viewer/model/bookmarks.hpp"

#include "engine/base/error.hpp"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>

namespace spheroscope::viewer {
namespace {

nlohmann::json json_of(const Bookmark& bookmark) {
    const scene::Picture& p = bookmark.view.picture;
    return {{"name", bookmark.name},
            {"frame", bookmark.frame},
            {"picture", p.name},
            {"field", p.field},
            {"size", p.size_px},
            {"range", p.range},
            {"given_range", p.given_range},
            {"cutaway", p.cutaway},
            {"network", p.network},
            {"stress_axes", p.stress_axes},
            {"exploded", p.exploded},
            {"azimuth", p.azimuth_deg},
            {"elevation", p.elevation_deg},
            {"orbit", p.orbit_deg},
            {"fps", p.fps},
            {"smooth", p.smooth},
            {"plot", p.plot},
            {"shots", p.shots}};
}

Bookmark bookmark_of(const nlohmann::json& json) {
    Bookmark bookmark;
    bookmark.name = json.at("name");
    bookmark.frame = json.at("frame");
    scene::Picture& p = bookmark.view.picture;
    p.name = json.at("picture");
    p.field = json.at("field");
    p.size_px = json.at("size");
    p.range = json.at("range");
    p.given_range = json.at("given_range");
    p.cutaway = json.at("cutaway");
    p.network = json.at("network");
    // Not in bookmarks of before these were there.
    p.stress_axes = json.value("stress_axes", false);
    p.exploded = json.value("exploded", 0.0);
    p.azimuth_deg = json.at("azimuth");
    p.elevation_deg = json.at("elevation");
    p.orbit_deg = json.at("orbit");
    p.fps = json.at("fps");
    p.smooth = json.at("smooth");
    p.plot = json.at("plot");
    p.shots = json.at("shots");
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
    const std::string partial = path + ".partial";
    std::ofstream file(partial);
    file << nlohmann::json{{"bookmarks", items}}.dump(1) << "\n";
    file.close();
    std::error_code failed;
    if (file) std::filesystem::rename(partial, path, failed);
    if (!file || failed)
        throw Error(Loc{path, 0, 0}, "the bookmarks cannot be written", "is the folder writable?",
                    ExitCode::environment);
}

std::string bookmarks_path(const std::string& run_file) {
    return std::filesystem::path(run_file).replace_extension(".bookmarks.json").string();
}

}  // namespace spheroscope::viewer
