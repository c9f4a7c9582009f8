#pragma once

#include "engine/cli/verb.hpp"

#include <vector>

namespace spheroscope {

/// The verbs that make pictures; the program adds them to the engine's.
[[nodiscard]] std::vector<cli::Verb> render_verbs();

/// Draws the plots of reports.
[[nodiscard]] reports::DrawPlot plot_drawer();

// One file verb_<name>.cpp each.
[[nodiscard]] cli::Verb movie_verb();
[[nodiscard]] cli::Verb render_verb();
[[nodiscard]] cli::Verb diff_verb();
[[nodiscard]] cli::Verb export_verb();
[[nodiscard]] cli::Verb figures_verb();

}  // namespace spheroscope
