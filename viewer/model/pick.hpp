#pragma once

#include "engine/run/snapshot.hpp"

#include <optional>
#include <string>
#include <vector>

namespace spheroscope::viewer {

/// A line of sight into a picture; and which cells the picture leaves out.
struct Sight {
    Vec3 origin_um;        ///< any point of the line
    Vec3 away_from_eye;    ///< unit vector
    bool cutaway = false;  ///< cells with their centre nearer than `middle_um` are not drawn
    Vec3 middle_um;
};

/// What stands under the pointer: the first surface on the line of sight.
struct Pick {
    int cell = -1, triangle = -1, node = -1;  ///< triangle and node (its nearest one) of that cell
    int other_cell = -1;                      ///< that touches the cell there; -1: none
    Vec3 point_um;
};
/// Throws Error when the run's scene, which says how far contacts reach, cannot be read.
[[nodiscard]] std::optional<Pick> pick(const Snapshot& snapshot, const Sight& sight);

/// What a sight would have found that meets the middle of this triangle.
[[nodiscard]] Pick pick_triangle(const Snapshot& snapshot, int cell, int triangle);
/// The triangle of `cell` that is nearest to the middle of the other cell.
[[nodiscard]] Pick pick_contact(const Snapshot& snapshot, int cell, int other_cell);
[[nodiscard]] double triangle_area_um2(const Snapshot& snapshot, int cell, int triangle);

/// One line of the table beside the picture. Empty value: a heading.
struct TableRow {
    std::string what, value, unit;
};
/// Everything that the frame knows about the node, triangle, cell and contact; in the units of
/// legends. NaN is what the field calls it, never a number. While beads are being seeded: geometry
/// alone.
[[nodiscard]] std::vector<TableRow> describe(const Snapshot& snapshot, const Pick& pick);

/// The rows as CSV (RFC 4180), with a heading line and comments that say of which frame.
[[nodiscard]] std::string csv_text(const Snapshot& snapshot, const std::vector<TableRow>& rows);

}  // namespace spheroscope::viewer
