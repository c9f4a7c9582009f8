#include "viewer/model/view.hpp"

#include "engine/scene/key_text.hpp"
#include "engine/scene/picture_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace spheroscope::viewer {

bool operator==(const ViewSettings& a, const ViewSettings& b) {
    // Without a given range its two numbers mean nothing, but they come back with an undo.
    const scene::Picture &p = a.picture, &q = b.picture;
    bool are_equal = p.name == q.name && p.fps == q.fps && p.shots == q.shots;
    scene::visit_shown_of([&](const char*, const auto& of_p,
                              const auto& of_q) { are_equal = are_equal && of_p == of_q; },
                          p, q);
    return are_equal;
}

std::string view_text(const ViewSettings& view) {
    scene::Draft draft;
    draft.scene.pictures = {view.picture};
    std::string text = "[[picture]]\n";
    for (const scene::Key& key : scene::all_keys())
        if (key.table == "picture" && (key.applies.holds == nullptr || key.applies.holds(draft, 0)))
            text += fmt::format("{} = {}\n", key.name, scene::value_text(draft, key, 0));
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
