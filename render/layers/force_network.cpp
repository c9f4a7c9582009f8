#include "render/layers/force_network.hpp"

#include "render/layers/tubes.hpp"

#include <cmath>

namespace spheroscope::render {

namespace {

constexpr double k_unit_tube_share = 0.09;  // radius of the tube at f = 1 over the mean cell radius
constexpr double k_ball_share = 0.15;       // radius of a centre's ball over the mean cell radius
constexpr Rgb k_ball_colour{58, 60, 66};

constexpr Rgb k_weak_compression{178, 198, 232}, k_strong_compression{18, 58, 150};
constexpr Rgb k_weak_tension{246, 196, 184}, k_strong_tension{176, 18, 32};

Vec3 centre_of(const Snapshot& snapshot, int cell) {
    const std::size_t i = 3 * static_cast<std::size_t>(cell);
    return Vec3(static_cast<double>(snapshot.centre_um[i]),
                static_cast<double>(snapshot.centre_um[i + 1]),
                static_cast<double>(snapshot.centre_um[i + 2]));
}

}  // namespace

struct ForceNetwork::Hidden {
    explicit Hidden(double radius_um) : mean_radius_um(radius_um) {}
    double mean_radius_um;
    Tubes tubes;
};

ForceNetwork::ForceNetwork(double mean_radius_um)
    : hidden_(std::make_unique<Hidden>(mean_radius_um)) {}

ForceNetwork::~ForceNetwork() = default;

vtkActor* ForceNetwork::actor() { return hidden_->tubes.actor(); }

double ForceNetwork::tube_radius_um(double f) const {
    return k_unit_tube_share * hidden_->mean_radius_um * std::sqrt(f);
}

Rgb ForceNetwork::tube_colour(double force_nN, double f) {
    // Half strength at the mean force, full strength from three times the mean on.
    const double strength = f < 1.0 ? 0.5 * f * f : std::min(1.0, 0.5 + 0.25 * (f - 1.0));
    return force_nN > 0.0 ? mix(k_weak_compression, k_strong_compression, strength)
                          : mix(k_weak_tension, k_strong_tension, strength);
}

NetworkCount ForceNetwork::update(const Snapshot& snapshot) {
    Hidden& h = *hidden_;
    NetworkCount count;
    count.unit_radius_um = tube_radius_um(1.0);
    count.n_links = static_cast<int>(snapshot.links.size());
    for (const ContactLink& link : snapshot.links)
        count.mean_force_nN += std::abs(static_cast<double>(link.force_nN));
    if (count.n_links > 0) count.mean_force_nN /= count.n_links;

    h.tubes.clear();
    for (int cell = 0; cell < snapshot.header->n_cells; ++cell)
        h.tubes.add_ball(centre_of(snapshot, cell), k_ball_share * h.mean_radius_um, k_ball_colour);
    for (const ContactLink& link : snapshot.links) {
        const double force_nN = static_cast<double>(link.force_nN);
        const double f = count.mean_force_nN > 0.0 ? std::abs(force_nN) / count.mean_force_nN : 0.0;
        if (f < k_smallest_drawn) {
            ++count.n_left_out;
            continue;
        }
        h.tubes.add_tube(centre_of(snapshot, link.cell_a), centre_of(snapshot, link.cell_b),
                         tube_radius_um(f), tube_colour(force_nN, f));
    }

    h.tubes.finish();
    return count;
}

}  // namespace spheroscope::render
