#include "engine/statistics/bulk_modulus.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

namespace spheroscope::statistics {
namespace {

constexpr double k_nan = std::numeric_limits<double>::quiet_NaN();
/// Of the volume, over which the slope is fitted.
constexpr double k_last_share = 0.1;

double log_volume(double radius_um) { return 3.0 * std::log(radius_um); }

/// The first frame with the smallest radius.
std::size_t innermost(std::span<const WallPoint> wall) {
    return static_cast<std::size_t>(std::min_element(wall.begin(), wall.end(),
                                                     [](const WallPoint& a, const WallPoint& b) {
                                                         return a.radius_um < b.radius_um;
                                                     }) -
                                    wall.begin());
}

}  // namespace

double WallPoint::pressure_kPa() const {
    return force_nN / (4.0 * std::numbers::pi * radius_um * radius_um);
}

double bulk_modulus_moving_kPa(std::span<const WallPoint> wall) {
    if (wall.empty()) return k_nan;
    const std::span<const WallPoint> inward = wall.first(innermost(wall) + 1);
    const double end = log_volume(inward.back().radius_um);
    double n = 0.0, sum_x = 0.0, sum_p = 0.0, sum_xx = 0.0, sum_xp = 0.0;
    for (const WallPoint& point : inward) {
        const double x = log_volume(point.radius_um) - end, p = point.pressure_kPa();
        if (x > -std::log(1.0 - k_last_share)) continue;
        n += 1.0;
        sum_x += x;
        sum_p += p;
        sum_xx += x * x;
        sum_xp += x * p;
    }
    if (n < 3.0) return k_nan;
    return -(n * sum_xp - sum_x * sum_p) / (n * sum_xx - sum_x * sum_x);
}

double bulk_modulus_held_kPa(std::span<const WallPoint> wall, double free_radius_um) {
    if (wall.empty()) return k_nan;
    const std::size_t first = innermost(wall);
    std::size_t last = first;
    while (last + 1 < wall.size() && wall[last + 1].radius_um == wall[first].radius_um) ++last;
    if (last == first) return k_nan;
    const double strain = log_volume(free_radius_um) - log_volume(wall[last].radius_um);
    return strain > 0.0 ? wall[last].pressure_kPa() / strain : k_nan;
}

}  // namespace spheroscope::statistics
