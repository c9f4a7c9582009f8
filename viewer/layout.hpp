#pragma once

#include "viewer/panels/panel.hpp"

namespace spheroscope::viewer {

/// One frame of the panel, over the whole window: the picture with the timeline below it, on the
/// right all other panels of the table, and what there is to say.
void draw_layout(PanelContext& panel);

}  // namespace spheroscope::viewer
