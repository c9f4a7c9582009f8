#pragma once

#include "engine/scene/scene.hpp"
#include "engine/scene/units.hpp"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace spheroscope {

/// Something that changes while a run goes on: with the first step that begins at or after time_s.
/// A run with its changes is as reproducible as one without.
struct Change {
    double time_s = 0.0;         ///< model time
    std::string key;             ///< a row of all_changeable()
    std::vector<double> values;  ///< engine units; one, but for a range two
    friend bool operator==(const Change&, const Change&) = default;
};

/// A row of the table of what may change during a run.
struct ChangeableRow {
    enum class Of { engine, picture };
    std::string_view key;     ///< as in scene files; `picture.` is the first picture
    std::string_view symbol;  ///< UTF-8, for panels
    scene::Dimension dimension;
    Of of;                               ///< picture: the motion does not depend on it
    bool (*is_in)(const scene::Scene&);  ///< whether the scene has it
    std::vector<double> (*get)(const scene::Scene&);
    void (*set)(scene::Scene&, std::span<const double>);
};
[[nodiscard]] std::span<const ChangeableRow> all_changeable();
/// nullptr if there is no such row.
[[nodiscard]] const ChangeableRow* find_changeable(std::string_view key);

/// Throws Error, with the scene as it was: an unknown key, one that the scene does not have, a
/// value that a scene may not have either, for the same reason (engine/scene/limits.hpp).
void apply_change(scene::Scene& scene, const Change& change);

/// Those that the motion depends on; changes of pictures are left out.
[[nodiscard]] std::vector<Change> changes_of_motion(std::span<const Change> changes);

/// One line for each change, "12.5 cortex.tension.gamma 0.6": what a run's file holds.
[[nodiscard]] std::string changes_text(std::span<const Change> changes);
/// Gives back exactly what changes_text was given. Throws Error naming `name` and the line.
[[nodiscard]] std::vector<Change> parse_changes(const std::string& text, const std::string& name);

}  // namespace spheroscope
