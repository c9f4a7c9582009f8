#include "viewer/model/view.hpp"

#include "engine/scene/key_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace spheroscope::viewer {

bool operator==(const ViewSettings& a, const ViewSettings& b) {
    // Without a given range its two numbers mean nothing, but they come back with an undo.
    const scene::Picture &p = a.picture, &q = b.picture;
    return p.name == q.name && p.field == q.field && p.size_px == q.size_px && p.range == q.range &&
           p.given_range == q.given_range && p.cutaway == q.cutaway && p.network == q.network &&
           p.stress_axes == q.stress_axes && p.exploded == q.exploded &&
           p.azimuth_deg == q.azimuth_deg && p.elevation_deg == q.elevation_deg &&
           p.orbit_deg == q.orbit_deg && p.fps == q.fps && p.smooth == q.smooth &&
           p.plot == q.plot && p.shots == q.shots;
}

std::string view_text(const ViewSettings& view) {
    const scene::Picture& p = view.picture;
    std::string text = fmt::format("[[picture]]\nname = {}\nfield = {}\nsize = [{}, {}]\n"
                                   "range = \"{}\"\n",
                                   scene::toml_string(p.name), scene::toml_string(p.field),
                                   p.size_px[0], p.size_px[1], p.range);
    if (p.range == "given")
        text += fmt::format("given_range = [{}, {}]\n", p.given_range[0], p.given_range[1]);
    text += fmt::format("cutaway = {}\nnetwork = {}\nazimuth = \"{} deg\"\nelevation = \"{} deg\"\n"
                        "orbit = \"{} deg\"\nfps = {}\n",
                        p.cutaway, p.network, p.azimuth_deg, p.elevation_deg, p.orbit_deg, p.fps);
    if (p.stress_axes) text += "stress_axes = true\n";
    if (p.exploded > 0.0) text += fmt::format("exploded = {}\n", p.exploded);
    if (!p.smooth) text += "smooth = false\n";
    if (!p.plot.empty()) text += fmt::format("plot = {}\n", scene::toml_string(p.plot));
    for (std::size_t k = 0; k < p.shots.size(); ++k)
        text += (k == 0 ? "shots = [" : ", ") + scene::toml_string(p.shots[k]);
    if (!p.shots.empty()) text += "]\n";
    return text;
}

ViewSettings turned(ViewSettings view, double right_px, double down_px) {
    scene::Picture& p = view.picture;
    p.azimuth_deg = std::remainder(p.azimuth_deg - 180.0 / k_half_turn_px * right_px, 360.0);
    p.elevation_deg = std::clamp(p.elevation_deg + 180.0 / k_half_turn_px * down_px, -90.0, 90.0);
    return view;
}

std::span<const Direction> directions() {
    static constexpr std::array<Direction, 6> rows{{
        {"from the front", 0.0, 0.0},
        {"from the right", 90.0, 0.0},
        {"from behind", 180.0, 0.0},
        {"from the left", -90.0, 0.0},
        {"from above", 0.0, 90.0},
        {"oblique", 30.0, 20.0},
    }};
    return rows;
}

}  // namespace spheroscope::viewer
