#pragma once

namespace spheroscope {

// What is no contact of two triangles, for the kernel and its plain twin alike.

/// Below this a polygon is rounding, not an area; cells are some 100 um^2.
inline constexpr double k_smallest_polygon_um2 = 1e-9;
/// Below this share of its area a projected triangle is seen edge-on.
inline constexpr double k_edge_on = 1e-6;

}  // namespace spheroscope
