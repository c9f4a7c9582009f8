#include "engine/run/aggregate_shape.hpp"

#include <algorithm>
#include <cmath>

namespace spheroscope {
namespace {

Vec3 point(const std::vector<float>& x, std::size_t i) {
    return {double{x[3 * i]}, double{x[3 * i + 1]}, double{x[3 * i + 2]}};
}

}  // namespace

Vec3 cell_centre_um(const Snapshot& snapshot, std::size_t cell) {
    return point(snapshot.centre_um, cell);
}

Vec3 aggregate_centre_um(const Snapshot& snapshot) {
    Vec3 sum = Vec3::Zero();
    double volume_um3 = 0.0;
    for (std::size_t c = 0; c < snapshot.volume_um3.size(); ++c) {
        sum += double{snapshot.volume_um3[c]} * cell_centre_um(snapshot, c);
        volume_um3 += double{snapshot.volume_um3[c]};
    }
    return sum / volume_um3;
}

double aggregate_extent_um(const Snapshot& snapshot) {
    const Vec3 centre = aggregate_centre_um(snapshot);
    double farthest2 = 0.0;
    for (std::size_t i = 0; i < snapshot.x_um.size() / 3; ++i)
        farthest2 = std::max(farthest2, (point(snapshot.x_um, i) - centre).squaredNorm());
    return std::sqrt(farthest2);
}

}  // namespace spheroscope
