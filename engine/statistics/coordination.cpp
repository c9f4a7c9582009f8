#include "engine/statistics/coordination.hpp"

#include <algorithm>

namespace spheroscope::statistics {

double coordination(std::span<const PairForce> pairs, int n_cells, double touching_area_um2) {
    const auto n_touching = std::count_if(pairs.begin(), pairs.end(), [&](const PairForce& pair) {
        return pair.area_um2 > touching_area_um2;
    });
    return 2.0 * static_cast<double>(n_touching) / n_cells;
}

}  // namespace spheroscope::statistics
