#include "engine/stages/indentation.hpp"

#include "engine/stages/convex_hull.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace spheroscope {
namespace {

constexpr double k_steady_speed_um_per_s = 5e-4;
constexpr double k_steady_part = 1e-3;  // of the probe's force
constexpr double k_steady_s = 2.0;

/// The cells' centres (means of their nodes), weighted with their volumes.
Vec3 centre_of_mass_um(const Model& model, std::span<const Vec3> x_um) {
    Vec3 sum = Vec3::Zero();
    double volume_um3 = 0.0;
    for (int cell = 0; cell < model.n_cells(); ++cell) {
        Vec3 middle = Vec3::Zero();
        for (const Vec3& x : model.cell_nodes(x_um, cell)) middle += x;
        const double target_um3 = model.target_volume_um3[static_cast<std::size_t>(cell)];
        sum += target_um3 / model.n_nodes() * middle;
        volume_um3 += target_um3;
    }
    return sum / volume_um3;
}

/// How far a sphere whose centre moves along the line gets until it touches the first node.
double way_to_first_touch_um(std::span<const Vec3> x_um, const Vec3& origin_um,
                             const Vec3& direction, double radius_um) {
    double least_um = std::numeric_limits<double>::infinity();
    for (const Vec3& x : x_um) {
        const double along_um = (x - origin_um).dot(direction);
        const double aside2 = (x - origin_um - along_um * direction).squaredNorm();
        if (aside2 < radius_um * radius_um)
            least_um = std::min(least_um, along_um - std::sqrt(radius_um * radius_um - aside2));
    }
    return least_um;
}

std::string name_of_node(const Model& model, std::size_t node) {
    const auto n = static_cast<std::size_t>(model.n_nodes());
    return fmt::format("node {} of cell {}", node % n, node / n);
}

}  // namespace

void Indentation::begin(StageContext& context) const {
    const Model& model = context.system.model();
    const std::vector<Vec3>& x_um = context.state.x_um;
    const scene::Stage& p = parameters_;
    const Vec3 direction = Vec3(p.direction[0], p.direction[1], p.direction[2]).normalized();
    const Vec3 centre_um = centre_of_mass_um(model, x_um);

    const auto hull = std::make_shared<const Hull>(make_convex_hull(
        x_um, p.hull_gap_um, {centre_um, -direction, p.opening * p.probe_radius_um}));
    if (const auto outside = find_outside(*hull, x_um))
        throw Error(p.loc,
                    fmt::format("the hull does not contain the cells: {} is {:.4g} um outside",
                                name_of_node(model, outside->point), outside->distance_um),
                    "stage.hull_gap must not be negative");

    const double first_um = way_to_first_touch_um(x_um, centre_um, direction, p.probe_radius_um);
    if (!std::isfinite(first_um))
        throw Error(p.loc,
                    fmt::format("a probe of radius {} um meets no node on its way through the "
                                "centre of the cells",
                                p.probe_radius_um),
                    "typical: 27 um, three times a cell's");
    const Probe probe{.radius_um = p.probe_radius_um,
                      .force_nN = p.force_nN,
                      .friction_nN_s_per_um = p.probe_friction_nN_s_per_um,
                      .start_um = centre_um + (first_um - p.clearance_um) * direction,
                      .direction = direction};
    for (std::size_t i = 0; i < x_um.size(); ++i) {
        const double inside_um = probe.radius_um - (x_um[i] - probe.start_um).norm();
        if (inside_um > 1e-9 * probe.radius_um)  // the first node touches it but for rounding
            throw Error(p.loc,
                        fmt::format("the probe starts inside the cells: {} is {:.4g} um in it",
                                    name_of_node(model, i), inside_um),
                        "stage.clearance must not be negative");
    }
    context.state.load = {hull, probe};
    context.memory.samples.clear();
    context.state.has_velocity = false;
    context.state.next_dt_s = 0.0;
}

double Indentation::latest_end_s(const StageContext& context) const {
    return context.memory.start_s + (parameters_.until == scene::Until::duration
                                         ? parameters_.duration_s
                                         : parameters_.cap_s);
}

StageEnd Indentation::after_step(StageContext& context) const {
    const double now_s = context.state.time_s;
    if (parameters_.until == scene::Until::duration)
        return now_s >= latest_end_s(context) ? StageEnd::done : StageEnd::none;
    const Probe& probe = context.state.load.probe;
    // The forces where the step has ended, which the next one begins with, so they cost nothing.
    // What is not finite in them is found again, and reported, by that step.
    static_cast<void>(context.system.evaluate(context.state.x_um, context.state.volume_integral_s,
                                              0.0, context.state.load));
    const Configuration at = context.system.configuration();
    Vec3 sum_nN = Vec3::Zero();
    for (const Vec3& f : context.system.force_nN()) sum_nN += f;
    const double push_nN = context.system.parts().probe->sum_nN(at).dot(probe.direction);
    const double bound_nN = k_steady_part * probe.force_nN;
    const bool is_steady = std::abs(probe.speed_um_per_s) < k_steady_speed_um_per_s &&
                           std::abs(push_nN - probe.force_nN) < bound_nN &&
                           sum_nN.norm() < bound_nN;
    // The one sample is the time since when it has been steady.
    std::vector<double>& samples = context.memory.samples;
    if (!is_steady)
        samples.clear();
    else if (samples.empty())
        samples.push_back(now_s);
    if (!samples.empty() && now_s - samples[0] >= k_steady_s) return StageEnd::rest;
    return now_s >= latest_end_s(context) ? StageEnd::cap : StageEnd::none;
}

double Indentation::progress(const StageContext& context) const {
    if (parameters_.until == scene::Until::duration) return Stage::progress(context);
    return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace spheroscope
