#pragma once

#include "engine/inspect/contact_report.hpp"
#include "engine/inspect/frame_system.hpp"
#include "engine/stages/build.hpp"

#include <string>

namespace spheroscope::inspect {

/// Two cells of a run as a run of their own.
struct ExtractedPair {
    std::shared_ptr<const RunHeader> header;  ///< of a run of two cells, on the frame's own mesh
    Snapshot frame;                           ///< its only frame: positions to the bit
    HeldLoad load;
    std::string scene_toml;  ///< a scene that begins with that frame
};

/// Takes the contact's two cells out of the loaded frame (all cells, Detail::forces).
///
///   Gamma v = F holds for all cells of the frame. Of the pair alone, with the velocities v that
///   its cells have in the frame, F + held = Gamma v asks for held = Gamma v - F: the contacts and
///   frictions with all other cells, the wall and the loads of the scene at that moment.
///
/// run_file: what the scene names as the file of its cells. Throws Error when the cells do not
/// touch, or beads are still being packed.
[[nodiscard]] ExtractedPair extract_pair(FrameSystem& frame, const ContactKey& key,
                                         const std::string& run_file, double duration_s);

}  // namespace spheroscope::inspect
