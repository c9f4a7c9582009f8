#pragma once

#include "engine/scene/keys.hpp"

namespace spheroscope::scene {

/// Fills in what follows from several keys together (work of adhesion, PID times, moduli given as
/// ratios, bounds of [expect]) and checks that the parts of the scene fit each other. Throws Error;
/// notes warnings in the scene.
void resolve(Draft& draft);

/// The canonical text of a resolved draft: every key that applies, in the order of the table of
/// keys, in engine units. Reading it gives the same scene.
[[nodiscard]] std::string canonical_text(Draft& draft);

}  // namespace spheroscope::scene
