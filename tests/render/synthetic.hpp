#pragma once

#include "engine/run/snapshot.hpp"
#include "engine/scene/scene.hpp"

#include <memory>
#include <vector>

namespace spheroscope::render::synthetic {

/// Three fields that no engine computes, one for each place: tests fill in the values.
extern const Field k_node_field;  ///< "tension", magnitude, mN/m
extern const Field
    k_triangle_field;             ///< "normal_stress", signed, kPa shown as Pa, NaN: "no contact"
extern const Field k_cell_field;  ///< "mean_stress", signed, kPa shown as Pa

/// A run with these three fields and no frames yet.
[[nodiscard]] std::shared_ptr<RunHeader> make_header(int n_cells, int n_nodes);

/// Round cells of one radius at the given centres, with zero in all fields, no links.
[[nodiscard]] std::shared_ptr<Snapshot> make_balls(std::shared_ptr<const RunHeader> header,
                                                   const std::vector<Vec3>& centres_um,
                                                   double radius_um);

/// Cells of an aggregate: the n points of a jittered hexagonal packing nearest to its middle, cells
/// pressed flat where they meet, fields and links that look like an aggregate's. For looking at,
/// and for timing.
[[nodiscard]] std::shared_ptr<Snapshot> make_aggregate(int n_cells, int n_nodes,
                                                       double squeeze = 0.9);

/// A picture of that field, 640 x 360, everything else as scenes have it by default.
[[nodiscard]] scene::Picture make_picture(const std::string& field);

}  // namespace spheroscope::render::synthetic
