#pragma once

#include "engine/measures/fields.hpp"
#include "engine/scene/scene.hpp"
#include "engine/solve/method.hpp"

#include <vector>

// What a scene names by a word must be a row of a table of the engine. The scene reader does not
// know these tables; whoever is about to run, check or explain a scene asks here.
namespace spheroscope {

/// The row that method.name names. Throws Error with the names that exist.
[[nodiscard]] const MethodRow& chosen_method(const scene::Scene& scene);

/// Its steps are all of method.dt, not chosen by an error estimate.
[[nodiscard]] bool has_fixed_steps(const scene::Scene& scene);

/// The rows that measures.fields names, in its order. Throws Error for a name that does not exist,
/// or for a field whose part of the model the scene does not have.
[[nodiscard]] std::vector<const Field*> chosen_fields(const scene::Scene& scene);

/// Whether the scene has the part without which the field means nothing.
[[nodiscard]] bool has_part_of(const scene::Scene& scene, const Field& field);

/// The table whose absence makes a field meaningless, "[contact]"; "" if it needs none.
[[nodiscard]] std::string_view part_of(const Field& field);

}  // namespace spheroscope
