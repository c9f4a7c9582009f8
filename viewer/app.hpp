#pragma once

#include "viewer/frames.hpp"
#include "viewer/model/panel_model.hpp"
#include "viewer/window.hpp"

#include <string>
#include <vector>

namespace spheroscope::viewer {

class LiveRun;
class Painter;

struct AppSettings {
    std::string run_file;  ///< bookmarks and pictures go beside it
    std::string folder;    ///< for pictures
    std::string drawn_by;  ///< version of this program, for the pictures' texts
};

/// What a session came to.
struct AppReport {
    double first_picture_s = -1.0;  ///< wall time from the call; < 0: there was none
    double longest_pick_s = 0.0;
    double draft_s = 0.0, full_s = 0.0;  ///< of the last picture of either quality; 0: none
    double dragged_s = 0.0;              ///< wall time in which the view was being turned
    int dragged_pictures = 0;            ///< that were shown in it
    std::vector<std::string> files;      ///< that were written
    std::string copied;                  ///< what went into the clipboard last
};

/// Shows the panel until it is closed. `live`: the engine behind the frames; nullptr: there is
/// none. Throws Error when nothing can be drawn.
[[nodiscard]] AppReport run_app(Window& window, Frames& frames, Painter& painter, PanelModel& model,
                                LiveRun* live, const AppSettings& settings);

}  // namespace spheroscope::viewer
