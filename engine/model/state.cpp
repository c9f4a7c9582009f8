#include "engine/model/state.hpp"

#include "engine/base/fnv1a.hpp"

namespace spheroscope {
namespace {

void add(Fnv1a& fnv, const std::vector<Vec3>& vectors) {
    for (const Vec3& v : vectors)
        for (const double component : {v.x(), v.y(), v.z()}) fnv.add(component);
}

}  // namespace

std::uint64_t State::hash() const {
    Fnv1a fnv;
    fnv.add(time_s);
    add(fnv, x_um);
    for (const double integral : volume_integral_s) fnv.add(integral);
    for (const double value : {wall.radius_um, wall.speed_um_per_s, wall.time_s}) fnv.add(value);
    // the hull does not move, so its planes are not part of what must agree
    const Probe& probe = load.probe;
    if (probe.acts())
        for (const double value : {probe.way_um, probe.speed_um_per_s}) fnv.add(value);
    add(fnv, v_um_per_s);
    fnv.add(std::uint64_t{has_velocity ? 1U : 0U});
    for (const double value : {next_dt_s, fastest_rate_per_s, rate_time_s}) fnv.add(value);
    return fnv.value();
}

}  // namespace spheroscope
