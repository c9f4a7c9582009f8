#pragma once

#include "engine/run/error_estimate.hpp"
#include "engine/scene/scene.hpp"

namespace spheroscope {

/// The same scene with steps half as long: a quarter of the tolerance, or an eighth where the error
/// that is controlled grows with the cube of the step; half of the bounds that limit steps as well.
/// `run`: what the scene's own run took, for a step that follows the stability of the motion.
/// Precondition: the method's motion is one in time.
[[nodiscard]] scene::Scene with_half_steps(const scene::Scene& scene, double time_s,
                                           std::int64_t steps);

/// Adds the error by the time steps, from the end of a run with_half_steps, by Richardson: the
/// difference over 1 - 2^-order.
void set_time_error(std::vector<MeasureError>& errors, const Totals& finer, int order);

}  // namespace spheroscope
