#pragma once

#include "engine/scene/scene.hpp"

#include <array>
#include <string>
#include <string_view>

// What values of a scene may be, wherever they come from: a scene file, a change of a run that goes
// on, a field of the panel.
namespace spheroscope::scene {

/// Why the key cannot have this number, in its engine unit: "cortex.tension.gamma must be > 0, got
/// -1 nN/um"; "" if it can. `path` is that of a key that holds numbers, "picture.elevation".
[[nodiscard]] std::string problem_of_number(std::string_view path, double value);

/// The same of picture.given_range.
[[nodiscard]] std::string problem_of_range(const std::array<double, 2>& range);

/// Why the contacts of this scene would have no end: W above 2 gamma where the scene does not allow
/// it; "" if all is well.
[[nodiscard]] std::string problem_of_wetting(const Scene& scene);
/// Whether W is 2 gamma as far as rounded numbers tell.
[[nodiscard]] bool wets_fully(const Scene& scene);
inline constexpr std::string_view k_allow_wetting = "allow it with scene.allow_full_wetting = true";

}  // namespace spheroscope::scene
