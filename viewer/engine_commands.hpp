#pragma once

#include "viewer/model/panel_model.hpp"

namespace spheroscope::viewer {

class LiveRun;

/// Hands an action to the engine behind the frames, if it is one for it; `live` is nullptr where
/// there is none. Returns whether it was; what cannot be done is said in the model's message.
[[nodiscard]] bool command_engine(PanelModel& model, LiveRun* live, Action action);

}  // namespace spheroscope::viewer
