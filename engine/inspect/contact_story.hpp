#pragma once

#include "engine/inspect/contact_history.hpp"
#include "engine/inspect/frame_system.hpp"
#include "engine/run/step_anatomy.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace spheroscope::inspect {

/// One contact in one frame.
struct ContactMoment {
    SnapshotPtr frame;
    ContactSummary summary;
    std::optional<ContactReport> report;  ///< empty: the cells do not touch in this frame
};
/// `pair`: of the contact's two cells.
[[nodiscard]] ContactMoment contact_in(FrameSystem& pair, SnapshotPtr frame, const ContactKey& key);

/// One contact through a run, as those read it who draw it: its whole history, and each frame on
/// demand.
struct ContactStory {
    std::shared_ptr<const RunHeader> header;
    ContactKey key;
    std::vector<ContactSummary> history;  ///< one row for each frame
    std::vector<ContactEvent> events;
    std::function<ContactMoment(int frame)> at;
    std::string made_by;       ///< version of the program, for the files' texts
    std::string command_line;  ///< that makes the picture again
};

/// Reads the history. Throws Error when there is no such cell, or when the cells touch in no frame
/// of the run (with the nearest contacts of the last one).
[[nodiscard]] ContactStory tell_contact(const std::shared_ptr<const RunHeader>& header,
                                        const ReadFrame& read, int n_frames, const ContactKey& key);

/// Everything that acts on one node in one frame.
struct NodeMoment {
    SnapshotPtr frame;
    NodeForces forces;
};
/// `whole`: of all cells, with Detail::forces. Throws Error when there is no such cell or node.
[[nodiscard]] NodeMoment node_in(FrameSystem& whole, SnapshotPtr frame, const NodeOfCell& node);

/// What draws contacts and nodes; empty functions in a program that was built without pictures.
struct Drawers {
    std::function<void(const ContactStory&, int frame, const std::string& png)> contact_sheet;
    std::function<void(const ContactStory&, const std::string& mp4)> contact_movie;
    std::function<void(const NodeMoment&, const std::string& made_by, const std::string& command,
                       const std::string& png)>
        node_sheet;
};

}  // namespace spheroscope::inspect
