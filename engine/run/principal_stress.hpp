#pragma once

#include "engine/run/snapshot.hpp"

#include <array>
#include <optional>

namespace spheroscope {

/// Where the six components of the cells' stress (scene::k_stress_components) are among a run's
/// fields; nothing when one is missing.
using StressComponents = std::array<std::size_t, 6>;
[[nodiscard]] std::optional<StressComponents> find_stress_components(const RunHeader& header);

/// Stress of one cell along its principal axes.
struct PrincipalStress {
    Vec3 value_kPa;  ///< ascending; tension positive
    Mat3 axes;       ///< [:, k] unit vector of value k
};
/// Precondition: the frame has mechanics.
[[nodiscard]] PrincipalStress principal_stress(const Snapshot& snapshot,
                                               const StressComponents& components, int cell);

}  // namespace spheroscope
