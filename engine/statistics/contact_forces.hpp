#pragma once

#include "engine/measures/pair_forces.hpp"

#include <span>
#include <vector>

namespace spheroscope::statistics {

/// Over which pairs <F> is taken.
enum class ForceNorm {
    all,          ///< |F| of all touching pairs, as in the paper
    compressive,  ///< F of the pairs that push each other
};

/// Contact forces over their mean.
struct ContactForces {
    std::vector<double> f;       ///< one for each pair that counts, >= 0
    double mean_nN = 0.0;        ///< <F>; NaN without pairs
    double tensile_share = 0.0;  ///< of the touching pairs, those that pull; NaN without pairs
};
[[nodiscard]] ContactForces contact_forces(std::span<const PairForce> pairs,
                                           double touching_area_um2, ForceNorm norm);

}  // namespace spheroscope::statistics
