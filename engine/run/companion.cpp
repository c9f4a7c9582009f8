// A second run beside the first is the only estimate of the time error that holds wherever it was
// tried: while contacts spread, errors do not follow from what can be seen at the end of one run.
// Half the step, not twice: where errors fall more slowly than they should, the difference to the
// finer run still is a good part of the error, that to a coarser one is not.
#include "engine/run/companion.hpp"

#include "engine/stages/choices.hpp"

#include <cmath>

namespace spheroscope {

scene::Scene with_half_steps(const scene::Scene& scene, double time_s, std::int64_t steps) {
    const MethodRow& method = chosen_method(scene);
    SPHEROSCOPE_ASSERT(method.moves_in_time(), "a method with a motion in time");
    scene::Scene finer = scene;
    scene::Method& m = finer.method;
    const bool is_fixed = has_fixed_steps(scene);
    m.linear_tolerance *= method.order == 2 ? 0.25 : 0.5;
    m.displacement_bound_h0 *= 0.5;
    if (is_fixed && m.stable_step == scene::StableStep::follow)
        m.dt_max_s = std::min(m.dt_max_s, 0.5 * time_s / static_cast<double>(steps));
    else
        m.dt_max_s *= 0.5;
    m.dt_min_s = std::min(m.dt_min_s, m.dt_max_s);
    if (is_fixed || m.dt_s > m.dt_max_s) m.dt_s *= 0.5;
    m.tolerance_um *= std::pow(0.5, method.estimate_order);
    for (scene::Stage& stage : finer.stages) stage.frames = 0;
    return finer;
}

void set_time_error(std::vector<MeasureError>& errors, const Totals& finer, int order) {
    const double factor = 1.0 / (1.0 - std::pow(2.0, -order));
    for (MeasureError& error : errors)
        error.time = factor * std::abs(value_of(*find_total(error.measure), finer) - error.value);
}

}  // namespace spheroscope
