#include "engine/statistics/contact_forces.hpp"

#include <cmath>

namespace spheroscope::statistics {

ContactForces contact_forces(std::span<const PairForce> pairs, double touching_area_um2,
                             ForceNorm norm) {
    ContactForces forces;
    int n_touching = 0, n_tensile = 0;
    double sum_nN = 0.0;
    for (const PairForce& pair : pairs) {
        if (pair.area_um2 <= touching_area_um2) continue;
        ++n_touching;
        if (pair.force_nN < 0.0) ++n_tensile;
        if (norm == ForceNorm::compressive && pair.force_nN <= 0.0) continue;
        forces.f.push_back(std::abs(pair.force_nN));
        sum_nN += forces.f.back();
    }
    forces.mean_nN = sum_nN / static_cast<double>(forces.f.size());
    forces.tensile_share = static_cast<double>(n_tensile) / n_touching;
    for (double& f : forces.f) f /= forces.mean_nN;
    return forces;
}

}  // namespace spheroscope::statistics
