#include "engine/inspect/step_of_frame.hpp"

#include "engine/base/error.hpp"
#include "engine/stages/build.hpp"
#include "engine/stages/choices.hpp"

#include <limits>

namespace spheroscope::inspect {

StepAnatomy step_of_frame(FrameSystem& frame, std::optional<NodeOfCell> node) {
    const Snapshot& snapshot = frame.frame();
    const scene::Scene& scene = frame.scene();
    const scene::Stage& stage = scene.stages[static_cast<std::size_t>(snapshot.stage)];
    if (stage.kind == scene::StageKind::anneal)
        throw Error("frame " + std::to_string(snapshot.frame) +
                        " is of the seeding, which packs beads: no step of the cells begins there",
                    "take a later frame");
    System& system = frame.system();
    if (static_cast<int>(frame.cells().size()) != snapshot.header->n_cells)
        throw Error("a step is one of all cells");
    const Configuration at = system.configuration();
    if (at.load.probe.acts() && !(at.load.probe.friction_nN_s_per_um > 0.0))
        throw Error("frame " + std::to_string(snapshot.frame) +
                        ": the file, of an earlier version, does not say how the bead moves",
                    "run its scene again");
    State state;
    state.time_s = snapshot.time_s;
    state.x_um.assign(at.x_um.begin(), at.x_um.end());
    state.v_um_per_s.assign(state.x_um.size(), Vec3::Zero());
    state.volume_integral_s.assign(at.volume_integral_s.begin(), at.volume_integral_s.end());
    state.wall.radius_um = at.wall_radius_um;
    state.wall.time_s = snapshot.time_s;
    state.load = at.load;
    state.next_dt_s = snapshot.diagnostics.dt_s;
    const auto method = chosen_method(scene).make(method_parameters(scene));
    return take_apart(system, *method, state, std::numeric_limits<double>::infinity(),
                      state.wall.acts(), node);
}

}  // namespace spheroscope::inspect
