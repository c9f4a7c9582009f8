#include "engine/stages/jamming.hpp"

#include "engine/base/error.hpp"
#include "engine/base/random.hpp"
#include "engine/stages/bead_forces.hpp"
#include "engine/stages/fire_descent.hpp"

#include <cmath>
#include <numbers>

namespace spheroscope {
namespace {

std::vector<double> scaled_to(double packing_fraction, std::vector<double> radius) {
    double volume = 0.0;
    for (const double r : radius) volume += 4.0 / 3.0 * std::numbers::pi * r * r * r;
    const double factor = std::cbrt(packing_fraction / volume);
    for (double& r : radius) r *= factor;
    return radius;
}

/// Takes out beads that hold nothing: fewer than 4 contacts with beads that are still in.
std::vector<bool> backbone(const std::vector<BeadContact>& contacts, std::size_t n) {
    std::vector<bool> in(n, true);
    for (bool changed = true; changed;) {
        changed = false;
        std::vector<int> count(n, 0);
        for (const BeadContact& c : contacts) {
            const auto i = static_cast<std::size_t>(c.i), j = static_cast<std::size_t>(c.j);
            if (!in[i] || !in[j]) continue;
            ++count[i];
            ++count[j];
        }
        for (std::size_t i = 0; i < n; ++i) {
            if (in[i] && count[i] < 4) {
                in[i] = false;
                changed = true;
            }
        }
    }
    return in;
}

SettledBeads settle(std::vector<Vec3>& x, const std::vector<double>& radius, double fraction) {
    const std::size_t n = x.size();
    BeadForces forces(scaled_to(fraction, radius), {BeadBoundary::periodic, 1.0});
    constexpr double largest_dt = 0.3;
    FireState fire = make_fire_state(n, largest_dt);
    std::vector<Vec3> force(n);
    std::vector<BeadContact> contacts;
    double mean_force = 0.0, largest_force = 0.0;
    for (int step = 0;; ++step) {
        forces.compute(x, force);
        if (step % 200 == 0) {  // looking at all pairs costs as much as 100 steps
            contacts = forces.contacts(x);
            mean_force = 0.0;
            for (const BeadContact& c : contacts) mean_force += c.overlap;
            if (!contacts.empty()) mean_force /= static_cast<double>(contacts.size());
            largest_force = largest_norm(force);
            // Balanced to 1e-3 of a contact; or below the jamming point, where forces fade away.
            if (largest_force <= 1e-3 * mean_force || mean_force < 1e-9) break;
            if (step > 2000000) throw Error("the beads do not settle");
        }
        advance_fire(fire, largest_dt, force, x);
    }
    SettledBeads settled{fraction, 0.0, 0.0, 0.0, 0.0};
    const std::vector<bool> in = backbone(contacts, n);
    double n_in = 0.0, n_backbone_contacts = 0.0;
    for (std::size_t i = 0; i < n; ++i) n_in += in[i] ? 1.0 : 0.0;
    for (const BeadContact& c : contacts) {
        const auto i = static_cast<std::size_t>(c.i), j = static_cast<std::size_t>(c.j);
        const double diameter = forces.radius()[i] + forces.radius()[j];
        settled.overlap_per_bead += c.overlap / diameter / static_cast<double>(n);
        if (in[i] && in[j]) n_backbone_contacts += 1.0;
    }
    if (n_in > 0.0) settled.coordination = 2.0 * n_backbone_contacts / n_in;
    settled.rattlers = 1.0 - n_in / static_cast<double>(n);
    if (mean_force > 0.0) settled.worst_balance = largest_force / mean_force;
    return settled;
}

}  // namespace

JammingRun decompress_to_jamming(const std::vector<double>& radius, double first_fraction,
                                 double nearest, std::uint64_t seed) {
    const Random random(seed, static_cast<std::uint32_t>(RandomStream::bead_start));
    std::vector<Vec3> x;
    for (std::size_t i = 0; i < radius.size(); ++i) {
        x.emplace_back(random.uniform(i, 0), random.uniform(i, 1), random.uniform(i, 2));
    }
    JammingRun run;
    run.settled.push_back(settle(x, radius, first_fraction));
    run.settled.push_back(settle(x, radius, first_fraction - 0.005));
    while (true) {
        // Overlaps are proportional to the distance from jamming.
        const SettledBeads& a = run.settled[run.settled.size() - 2];
        const SettledBeads& b = run.settled.back();
        run.jamming_fraction = b.packing_fraction - b.overlap_per_bead *
                                                        (a.packing_fraction - b.packing_fraction) /
                                                        (a.overlap_per_bead - b.overlap_per_bead);
        const double above = b.packing_fraction - run.jamming_fraction;
        if (above <= nearest) return run;
        // A third of the way each time: the estimate improves before it could be overshot.
        run.settled.push_back(settle(x, radius, b.packing_fraction - above * 2.0 / 3.0));
        if (run.settled.back().overlap_per_bead < 1e-8) throw Error("fell below the jamming point");
    }
}

double coordination_exponent(const JammingRun& run) {
    // Slope of log(Z - 6) against log(distance): Z scatters by 0.02.
    constexpr double nearest = 4e-4;
    double n = 0.0, sum_x = 0.0, sum_y = 0.0, sum_xx = 0.0, sum_xy = 0.0;
    for (const SettledBeads& settled : run.settled) {
        const double above = settled.packing_fraction - run.jamming_fraction;
        if (above < nearest) continue;
        const double x = std::log(above), y = std::log(settled.coordination - 6.0);
        n += 1.0;
        sum_x += x;
        sum_y += y;
        sum_xx += x * x;
        sum_xy += x * y;
    }
    if (n < 3.0) throw Error("too few packings above jamming for an exponent");
    return (n * sum_xy - sum_x * sum_y) / (n * sum_xx - sum_x * sum_x);
}

}  // namespace spheroscope
