#pragma once

#include "engine/run/snapshot.hpp"

#include <optional>
#include <string>

namespace spheroscope::viewer {

/// Whose contacts are watched: those of one cell, the one contact of two, or (-1, -1) all.
struct Watched {
    int cell = -1, other_cell = -1;
};

/// What happened between two states of a run, in words: a stage begins, a watched contact forms,
/// breaks, or its force along the line of centres, which snapshots hold, changes sign. Empty:
/// nothing. The first contact is named, others are counted. While beads are being packed contacts
/// mean nothing.
[[nodiscard]] std::optional<std::string> event_between(const Snapshot& before, const Snapshot& now,
                                                       const Watched& watched);

}  // namespace spheroscope::viewer
