#pragma once

#include "engine/scene/scene.hpp"

#include <span>
#include <string>
#include <string_view>

namespace spheroscope::viewer {

/// How the spheroid is looked at: a [[picture]] of a scene, so that a movie can show the same.
struct ViewSettings {
    scene::Picture picture;
    friend bool operator==(const ViewSettings& a, const ViewSettings& b);
};

/// The view as a [[picture]] table, ready to be pasted into a scene.
[[nodiscard]] std::string view_text(const ViewSettings& view);

/// Turned by a drag of the mouse; the spheroid follows the pointer. Half a turn over
/// k_half_turn_px; the elevation ends at straight up and down.
inline constexpr double k_half_turn_px = 600.0;
[[nodiscard]] ViewSettings turned(ViewSettings view, double right_px, double down_px);

/// Where a camera can be put by name.
struct Direction {
    std::string_view name;
    double azimuth_deg, elevation_deg;
};
[[nodiscard]] std::span<const Direction> directions();

}  // namespace spheroscope::viewer
