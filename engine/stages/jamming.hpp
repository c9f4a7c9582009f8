#pragma once

#include "engine/base/vec3.hpp"

#include <cstdint>
#include <vector>

namespace spheroscope {

/// A bead packing in a periodic cube of edge 1, settled at one packing fraction.
struct SettledBeads {
    double packing_fraction;
    double overlap_per_bead;  ///< sum of overlap / diameter over pairs, over beads
    double coordination;      ///< contacts per bead that is not a rattler
    double rattlers;          ///< share of the beads; fewer than 4 contacts with non-rattlers
    double worst_balance;     ///< largest force over the mean contact force
};

/// Beads quenched from a random start far above jamming, then decompressed without noise, as O'Hern
/// et al. 2003, Phys. Rev. E 68, 011306, do: the jamming point is where the overlaps vanish.
struct JammingRun {
    std::vector<SettledBeads> settled;  ///< falling towards the jamming point
    double jamming_fraction;            ///< extrapolated from the last two
};

/// radius [n]: only ratios matter. Stops at a distance of `nearest` above the jamming fraction.
/// Throws Error when the beads do not settle.
[[nodiscard]] JammingRun decompress_to_jamming(const std::vector<double>& radius,
                                               double first_fraction, double nearest,
                                               std::uint64_t seed);

/// Exponent of Z - 6 over the distance from jamming (1/2 in O'Hern et al. 2003), fitted where Z - 6
/// is well above its scatter. Throws Error when fewer than three packings are.
[[nodiscard]] double coordination_exponent(const JammingRun& run);

}  // namespace spheroscope
