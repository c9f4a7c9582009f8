#pragma once

#include "engine/model/state.hpp"
#include "engine/run/checkpoint_data.hpp"
#include "engine/run/error_estimate.hpp"
#include "engine/run/snapshot.hpp"
#include "engine/stages/bead_packing.hpp"
#include "engine/stages/stage.hpp"

#include <vector>

namespace spheroscope {

/// Everything that decides how a run goes on: the state, and where in its schedule it is. A
/// checkpoint is this and nothing else, so a resumed run continues to the bit.
struct RunState {
    State state;
    std::vector<double> radius_um;  ///< [cells]
    int stage = 0;                  ///< index; n_stages: the run is over
    bool stage_has_begun = false;
    StageMemory memory;
    std::int64_t outputs_in_stage = 0;
    int frames = 0;          ///< published since the start of the run
    BeadPackingState beads;  ///< while an anneal stage runs
    // Power balance since the last measurement.
    double dissipation_nN_um_per_s = 0.0;  ///< v . Gamma v of the last step
    bool has_energy = false;
    double energy_fJ = 0.0;      ///< at the last measurement
    double dissipated_fJ = 0.0;  ///< integral of v . Gamma v since then
    double driven_fJ = 0.0;      ///< work put in by the wall and the controller since then
    ApproachToRest approach;
    Diagnostics diagnostics;
    StageEnd end = StageEnd::none;  ///< how the last finished stage ended
    bool met_cap = false;           ///< a stage has ended at its cap
};

[[nodiscard]] CheckpointData save(const RunState& run);
/// Throws Error when something is missing or has the wrong size.
[[nodiscard]] RunState load_run_state(const CheckpointData& data);

}  // namespace spheroscope
