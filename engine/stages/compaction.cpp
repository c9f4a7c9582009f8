#include "engine/stages/compaction.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace spheroscope {
namespace {

/// Time over which the rise of the contact fraction is taken: long enough to average over the steps
/// (tens of ms), short against the compaction.
constexpr double k_rate_window_s = 0.5;

double total_volume_um3(const System& system) {
    const auto& volumes = system.geometry().volume_um3;
    return std::accumulate(volumes.begin(), volumes.end(), 0.0);
}

double contact_fraction(const System& system) {
    double contact_um2 = 0.0, surface_um2 = 0.0;
    for (const Contacts::Group& group : system.contacts().groups)
        for (const ContactPair& pair : group.pairs) contact_um2 += pair.area_um2;
    for (const double area_um2 : system.geometry().area_um2) surface_um2 += area_um2;
    return 2.0 * contact_um2 / surface_um2;
}

void set_wall(State& state, double radius_um, double speed_um_per_s) {
    state.wall = {radius_um, speed_um_per_s, state.time_s};
    state.has_velocity = false;  // the motion changes abruptly: the last velocity predicts nothing
    state.next_dt_s = 0.0;
}

}  // namespace

void Compaction::begin(StageContext& context) const {
    double touching_um = 0.0;
    for (const Vec3& x : context.state.x_um) touching_um = std::max(touching_um, x.norm());
    double volume_um3 = 0.0;
    for (const double target_um3 : context.system.model().target_volume_um3)
        volume_um3 += target_um3;
    const double R_th_um = std::cbrt(3.0 * volume_um3 / (4.0 * std::numbers::pi));
    context.memory.touching_wall_um = touching_um;
    context.memory.samples.clear();
    set_wall(context.state, touching_um, -(touching_um - R_th_um) / parameters_.duration_s);
}

StageEnd Compaction::after_step(StageContext& context) const {
    const double R_um = context.state.wall.radius_um;
    const double wall_volume_um3 = 4.0 / 3.0 * std::numbers::pi * R_um * R_um * R_um;
    if (total_volume_um3(context.system) >= parameters_.volume_fraction * wall_volume_um3)
        return StageEnd::done;
    // Samples are (time, contact fraction), over the last window.
    std::vector<double>& samples = context.memory.samples;
    samples.push_back(context.state.time_s);
    samples.push_back(contact_fraction(context.system));
    while (samples.size() > 4 && samples[2] <= context.state.time_s - k_rate_window_s)
        samples.erase(samples.begin(), samples.begin() + 2);
    const double window_s = samples[samples.size() - 2] - samples[0];
    if (window_s >= 0.9 * k_rate_window_s &&
        samples.back() - samples[1] < parameters_.contact_rate_per_s * window_s)
        return StageEnd::done;
    return Stage::after_step(context);
}

void Hold::begin(StageContext& context) const {
    set_wall(context.state, context.state.wall.radius_um, 0.0);
}

void Release::begin(StageContext& context) const {
    const double way_um = context.memory.touching_wall_um - context.state.wall.radius_um;
    set_wall(context.state, context.state.wall.radius_um, way_um / parameters_.duration_s);
}

void Release::end(StageContext& context) const { set_wall(context.state, 0.0, 0.0); }

}  // namespace spheroscope
