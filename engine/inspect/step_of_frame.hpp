#pragma once

#include "engine/inspect/frame_system.hpp"
#include "engine/run/step_anatomy.hpp"

namespace spheroscope::inspect {

/// The step that the scene's method would make from a stored frame, taken apart: forces before and
/// after each term, the residual of each solve. A frame has no velocities and no speed of the wall:
/// the solver starts from zero, and the wall stands still. node: in the run's numbers. Throws Error
/// for a frame of the seeding, for a node that is not there, and for a frame whose system is not
/// that of all cells.
[[nodiscard]] StepAnatomy step_of_frame(FrameSystem& frame, std::optional<NodeOfCell> node);

}  // namespace spheroscope::inspect
