#pragma once

#include "engine/base/random.hpp"
#include "engine/contact/triangle_pair.hpp"

#include <array>

namespace spheroscope::test {

/// A triangle of given corners, with its normal.
[[nodiscard]] TriangleGeometry triangle_of(const std::array<Vec3, 3>& corner_um);
/// A triangle in the plane z = 0 whose normal is +z, of side about 1.5 um.
[[nodiscard]] std::array<Vec3, 3> flat_triangle(const Random& random, std::uint64_t index);
/// The same triangle with the other face up.
[[nodiscard]] std::array<Vec3, 3> turned_over(const std::array<Vec3, 3>& corner_um);
[[nodiscard]] std::array<Vec3, 3> moved(std::array<Vec3, 3> corner_um, const Mat3& turn,
                                        const Vec3& shift_um);

/// The ways in which two triangles can face each other.
enum class Facing { tilted, parallel, nearly_parallel, shared_edge };
inline constexpr std::array<Facing, 4> k_all_facings{Facing::tilted, Facing::parallel,
                                                     Facing::nearly_parallel, Facing::shared_edge};

struct TrianglePair {
    std::array<Vec3, 3> a, b;
};
/// Two triangles whose gap is within the range of the law, turned and moved together at random.
///   tilted: half a wedge of up to 50 degrees; parallel: exactly (no common turn); nearly_parallel:
///   tilt 1e-12; shared_edge: projections along n with one edge in common.
[[nodiscard]] TrianglePair random_pair(const Random& random, std::uint64_t index, Facing facing,
                                       double h0_um);

}  // namespace spheroscope::test
