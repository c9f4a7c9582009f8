#pragma once

#include "engine/inspect/contact_report.hpp"
#include "engine/inspect/frame_system.hpp"

#include <vector>

namespace spheroscope::inspect {

/// The contacts of the loaded frame that are larger than the scene's touching_area, largest
/// |centre force| first, equal ones by their cells.
[[nodiscard]] std::vector<ContactSummary> contacts_of(const FrameSystem& frame);

/// The numbers of one contact; `exists` is false where there is none. Both cells must be among the
/// frame's.
[[nodiscard]] ContactSummary summarize(const FrameSystem& frame, const ContactKey& key);

/// The contact, taken apart. Throws Error with the nearest contacts when there is none in this
/// frame, or no such cell.
[[nodiscard]] ContactReport inspect_contact(const FrameSystem& frame, const ContactKey& key);

/// Contacts of a frame near to where the one of `key` would be, nearest first: by the distance of
/// the cells' centres. Reads the snapshot's links alone.
[[nodiscard]] std::vector<ContactKey> nearest_contacts(const Snapshot& frame, const ContactKey& key,
                                                       int n_wanted);

/// How far surfaces that act on each other can lie apart, or in each other, by the contact law of
/// the run's scene; 0 without [contact]. Throws Error when the scene cannot be read.
[[nodiscard]] double contact_reach_um(const RunHeader& header);

/// Throws Error (usage) unless both cells are in the run.
void check_cells(const RunHeader& header, const ContactKey& key);

/// Every force on one node of a cell of the run. The frame must have all cells and Detail::forces.
/// Throws Error when there is no such cell or node.
[[nodiscard]] NodeForces forces_on_node(FrameSystem& frame, int cell, int node);

}  // namespace spheroscope::inspect
