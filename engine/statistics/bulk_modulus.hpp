#pragma once

#include <span>

// The effective bulk modulus K' of an aggregate, which is that of its pores and of the cells'
// surfaces: the cells themselves keep their volumes. From its compaction by a spherical wall of
// radius R, whose forces sum to F: pressure p = F / 4 pi R^2, volume V = 4/3 pi R^3.
namespace spheroscope::statistics {

/// One frame with a wall.
struct WallPoint {
    double radius_um, force_nN;  ///< F: sum of |force| over the nodes
    [[nodiscard]] double pressure_kPa() const;
};

/// K' = -dp / d ln V while the wall moves inward, over the last tenth of its volume, kPa: with the
/// friction of that motion. NaN with fewer than three frames there.
[[nodiscard]] double bulk_modulus_moving_kPa(std::span<const WallPoint> wall);

/// K' = p / ln(V_free / V) when the wall has stood still for longest, kPa: from the free aggregate,
/// which reaches `free_radius_um` from its middle, to the held one. NaN where the wall is not held,
/// or holds nothing together.
[[nodiscard]] double bulk_modulus_held_kPa(std::span<const WallPoint> wall, double free_radius_um);

}  // namespace spheroscope::statistics
