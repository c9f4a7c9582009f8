#pragma once

namespace spheroscope::scene {

/// Sides that a picture may have, px. Smaller ones have no room for a scale and a unit, larger ones
/// none in a movie.
inline constexpr int k_smallest_side_px = 64, k_largest_side_px = 4096;

}  // namespace spheroscope::scene
