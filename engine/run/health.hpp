#pragma once

#include "engine/solve/system.hpp"

#include <optional>
#include <span>

namespace spheroscope {

/// Cells that lie deeper inside each other than their contact law reaches: what they do from here
/// on is not the motion of the model, and looks healthy. Names cell, node and depth; empty if there
/// are none, or no contacts.
[[nodiscard]] std::optional<Trouble>
cells_inside_each_other(System& system, std::span<const Vec3> x_um, const Loc& contact);

/// Where a failure is not told its place (a linear system that was not solved), names the flattest
/// triangle if it is flat enough to be the reason.
void name_flattest_triangle(const Model& model, std::span<const Vec3> x_um, Trouble& trouble);

}  // namespace spheroscope
