#include "engine/stages/bead_packing.hpp"

#include "engine/base/counted.hpp"
#include "engine/base/error.hpp"
#include "engine/base/random.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace spheroscope {
namespace {

// Angular frequencies of touching beads of unit mass and stiffness stay below sqrt(2 Z), Z <= 14
// contacts each: 2 / 5.3 = 0.38 is the limit.
constexpr double k_fire_dt = 0.3;

Random stream(std::uint64_t seed, RandomStream use) {
    return {seed, static_cast<std::uint32_t>(use)};
}

/// Fails for wrong values and for NaN, which compares false with everything.
void require(bool condition, const std::string& message, const std::string& hint) {
    if (!condition) throw Error(message, hint);
}

void check(const RadiusDistribution& d, int n) {
    require(n >= 1, fmt::format("at least one radius wanted, got n = {}", n), "give n >= 1");
    require(d.shape >= 1.0, fmt::format("shape of the radii >= 1 wanted, got {}", d.shape),
            "shape = (mean / standard deviation)^2");
    require(d.scale_um > 0.0, fmt::format("scale of the radii > 0 wanted, got {} um", d.scale_um),
            "scale = variance / mean");
    require(
        d.min_um > 0.0 && d.min_um < d.max_um,
        fmt::format("radii 0 < min < max wanted, got min = {} um, max = {} um", d.min_um, d.max_um),
        "the paper uses 5 um and 13 um");
}

/// Hands the radii on when they and the parameters can be packed.
std::vector<double> checked(std::vector<double> radius_um, const BeadPackingParameters& p) {
    require(!radius_um.empty(), "at least one bead wanted, got none", "give a radius per bead");
    for (const double r : radius_um) {
        require(r > 0.0 && std::isfinite(r), fmt::format("radius > 0 wanted, got {} um", r), "");
    }
    require(p.packing_fraction > 0.0 && p.packing_fraction < 1.0,
            fmt::format("packing_fraction between 0 and 1 wanted, got {}", p.packing_fraction),
            "0.60 lies a little below random close packing");
    require(p.steps >= 1, fmt::format("at least one annealing step wanted, got {}", p.steps),
            "the usual number is 20000");
    // Explicit Euler: dt * (largest eigenvalue, up to 2 Z with Z = 6 at the end) < 2.
    require(p.dt > 0.0 && p.dt <= 0.15,
            fmt::format("annealing dt in (0, 0.15] zeta/k_max wanted, got {}", p.dt), "use 0.1");
    require(p.first_noise >= 0.0 && p.noise_decay >= 0.0 && p.centring >= 0.0,
            "first_noise, noise_decay and centring >= 0 wanted", "0 switches a part off");
    require(p.first_stiffness > 0.0 && p.first_stiffness <= 1.0,
            fmt::format("first_stiffness in (0, 1] wanted, got {}", p.first_stiffness), "");
    require(p.force_tolerance > 0.0 && p.descent_steps_max >= 1 && p.accepted_overlap > 0.0,
            "force_tolerance, descent_steps_max and accepted_overlap > 0 wanted", "");
    return radius_um;
}

/// Gamma variate of scale 1 (Marsaglia & Tsang 2000, ACM Trans. Math. Softw. 26, 363), or a value
/// <= 0 when this attempt is rejected (about one in 500 at shape 38).
double try_gamma(double shape, double normal, double uniform) {
    const double d = shape - 1.0 / 3.0;
    const double root = 1.0 + normal / std::sqrt(9.0 * d);
    const double v = root * root * root;
    if (v <= 0.0) return 0.0;
    const bool accepted = std::log(uniform) < 0.5 * normal * normal + d * (1.0 - v + std::log(v));
    return accepted ? d * v : 0.0;
}

double mean_of(std::span<const double> values) {
    double sum = 0.0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
}

double box_radius(std::span<const double> radius, double packing_fraction) {
    double cubes = 0.0;
    for (const double r : radius) cubes += r * r * r;
    return std::cbrt(cubes / packing_fraction);
}

}  // namespace

std::vector<double> draw_radii(const RadiusDistribution& distribution, int n, std::uint64_t seed) {
    check(distribution, n);
    // A range so far out that this many attempts miss it was not meant.
    constexpr std::uint32_t k_attempts = 10000;
    const Random random = stream(seed, RandomStream::cell_radius);
    std::vector<double> radius_um;
    radius_um.reserve(static_cast<std::size_t>(n));
    for (int i = 0; i < n; ++i) {
        const auto index = static_cast<std::uint64_t>(i);
        double r_um = 0.0;
        for (std::uint32_t attempt = 0;; ++attempt) {
            if (attempt == k_attempts) {
                throw Error(fmt::format("{} draws gave no radius between {} and {} um (mean {} um)",
                                        k_attempts, distribution.min_um, distribution.max_um,
                                        distribution.shape * distribution.scale_um),
                            "widen the range or move the mean into it");
            }
            r_um = distribution.scale_um * try_gamma(distribution.shape,
                                                     random.normal(index, 2 * attempt),
                                                     random.uniform(index, 2 * attempt + 1));
            if (r_um >= distribution.min_um && r_um <= distribution.max_um) break;
        }
        radius_um.push_back(r_um);
    }
    return radius_um;
}

BeadPacking::BeadPacking(std::vector<double> radius_um, const BeadPackingParameters& parameters,
                         std::uint64_t seed)
    : radius_um_(checked(std::move(radius_um), parameters)), parameters_(parameters), seed_(seed),
      mean_radius_um_(mean_of(radius_um_)),
      box_radius_um_(box_radius(radius_um_, parameters.packing_fraction)), forces_(make_forces()),
      force_(radius_um_.size()), centre_um_(radius_um_.size()) {
    start();
    update_centres();
}

BeadForces BeadPacking::make_forces() const {
    std::vector<double> radius;
    radius.reserve(radius_um_.size());
    for (const double r_um : radius_um_) radius.push_back(r_um / mean_radius_um_);
    const double box = box_radius_um_ / mean_radius_um_;
    return BeadForces(std::move(radius), {BeadBoundary::sphere, box},
                      parameters_.centring / (box * box));
}

void BeadPacking::start() {
    const Random random = stream(seed_, RandomStream::bead_start);
    state_.x.reserve(radius_um_.size());
    for (std::size_t i = 0; i < radius_um_.size(); ++i) {
        // Evenly in the ball where the bead does not touch the wall.
        const double room = forces_.box().size - forces_.radius()[i];
        const double distance = room * std::cbrt(random.uniform(i, 0));
        const double cosine = 2.0 * random.uniform(i, 1) - 1.0;
        const double angle = 2.0 * std::numbers::pi * random.uniform(i, 2);
        const double sine = std::sqrt(1.0 - cosine * cosine);
        state_.x.emplace_back(distance * sine * std::cos(angle), distance * sine * std::sin(angle),
                              distance * cosine);
    }
}

void BeadPacking::advance(int n_steps) {
    SPHEROSCOPE_ASSERT(n_steps >= 0, "steps only go forward");
    for (int done = 0; done < n_steps && !is_finished(); ++done) {
        if (state_.phase == PackingPhase::annealing) {
            anneal_step();
        } else {
            descent_step();
        }
    }
    update_centres();
}

void BeadPacking::anneal_step() {
    const double s = static_cast<double>(state_.step) / static_cast<double>(parameters_.steps);
    const double stiffness = parameters_.first_stiffness + (1.0 - parameters_.first_stiffness) * s;
    const double noise = parameters_.first_noise * std::exp(-parameters_.noise_decay * s);
    const Random random = stream(seed_, RandomStream::bead_noise);
    const std::uint64_t first_index = static_cast<std::uint64_t>(state_.step) * state_.x.size();
    forces_.compute(state_.x, force_);
    for (std::size_t i = 0; i < state_.x.size(); ++i) {
        const std::uint64_t index = first_index + i;
        const Vec3 kick(random.normal(index, 0), random.normal(index, 1), random.normal(index, 2));
        state_.x[i] += parameters_.dt * (stiffness * force_[i] + noise * kick);
    }
    if (++state_.step == parameters_.steps) {
        state_.phase = PackingPhase::descent;
        state_.fire = make_fire_state(state_.x.size(), k_fire_dt);
    }
}

void BeadPacking::descent_step() {
    forces_.compute(state_.x, force_);
    state_.largest_force = largest_norm(force_);
    if (state_.largest_force < parameters_.force_tolerance ||
        state_.descent_step == parameters_.descent_steps_max) {
        state_.phase = PackingPhase::finished;
        return;
    }
    advance_fire(state_.fire, k_fire_dt, force_, state_.x);
    ++state_.descent_step;
}

void BeadPacking::update_centres() {
    for (std::size_t i = 0; i < centre_um_.size(); ++i) {
        centre_um_[i] = mean_radius_um_ * state_.x[i];
    }
}

double BeadPacking::progress() const {
    return static_cast<double>(state_.step) / static_cast<double>(parameters_.steps);
}

PackingOutcome BeadPacking::outcome() const {
    PackingOutcome outcome;
    outcome.largest_force = state_.largest_force;
    double sum = 0.0;
    for (const BeadContact& contact : forces_.contacts(state_.x)) {
        const double diameter = forces_.radius()[static_cast<std::size_t>(contact.i)] +
                                forces_.radius()[static_cast<std::size_t>(contact.j)];
        sum += contact.overlap / diameter;
        outcome.largest_overlap = std::max(outcome.largest_overlap, contact.overlap / diameter);
        ++outcome.n_contacts;
    }
    if (outcome.n_contacts > 0) outcome.mean_overlap = sum / outcome.n_contacts;
    if (!is_finished()) {
        outcome.reason = fmt::format("the beads still move, {:.0f} % of the annealing is done",
                                     100.0 * progress());
    } else if (!(outcome.largest_force < parameters_.force_tolerance)) {
        outcome.verdict = PackingVerdict::unbalanced;
        outcome.reason = fmt::format("after {} a bead still feels {:.3g} k_max R, wanted {:.3g}; "
                                     "allow more steps or another seed",
                                     counted(state_.descent_step, "descent step"),
                                     outcome.largest_force, parameters_.force_tolerance);
    } else if (outcome.mean_overlap > parameters_.accepted_overlap) {
        outcome.verdict = PackingVerdict::overlapping;
        outcome.reason =
            fmt::format("touching beads overlap by {:.2f} % of their diameter on average, accepted "
                        "are {:.2f} %; lower the packing fraction {}",
                        100.0 * outcome.mean_overlap, 100.0 * parameters_.accepted_overlap,
                        parameters_.packing_fraction);
    } else {
        outcome.verdict = PackingVerdict::packed;
    }
    return outcome;
}

void BeadPacking::restore(const BeadPackingState& state) {
    const std::size_t n = radius_um_.size();
    // FIRE has no memory before the descent begins.
    const std::size_t n_velocities = state.phase == PackingPhase::annealing ? 0 : n;
    if (state.x.size() != n || state.fire.velocity.size() != n_velocities) {
        throw Error(fmt::format("the saved packing wants {} with {} of them moving, got {} with {}",
                                counted(n, "bead"), n_velocities, state.x.size(),
                                state.fire.velocity.size()),
                    "resume with the scene that the checkpoint was made from");
    }
    state_ = state;
    update_centres();
}

}  // namespace spheroscope
