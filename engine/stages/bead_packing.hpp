#pragma once

#include "engine/stages/bead_forces.hpp"
#include "engine/stages/fire_descent.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace spheroscope {

/// Gamma distribution of cell radii, cut off at both ends (Cuvelier et al. 2021, Appendix E: shape
/// 37.75, scale 0.24 um; mean 9.06 um, standard deviation 1.475 um before the cut).
struct RadiusDistribution {
    double shape = 37.75;
    double scale_um = 0.24;
    double min_um = 5.0;
    double max_um = 13.0;
};

/// n radii, um. Radius i depends on (distribution, seed, i) only: more beads leave the first ones
/// as they are. Values outside [min, max] are drawn again. Throws Error when n < 1, shape < 1,
/// scale <= 0, not 0 < min < max, or when hardly any of the distribution lies in [min, max].
[[nodiscard]] std::vector<double> draw_radii(const RadiusDistribution& distribution, int n,
                                             std::uint64_t seed);

/// The annealing of Cuvelier et al. 2021, Appendix E: a random force decays exponentially while the
/// repulsion stiffness rises linearly; the numbers are ours, the paper gives none. No unit appears:
/// length in mean radii R, force in k_max R (k_max: final stiffness of the beads), time in
/// zeta / k_max (zeta: drag of a bead), s = step / steps from 0 to 1.
struct BeadPackingParameters {
    /// Volume of the beads / volume of the sphere around them. Few beads pack less densely at the
    /// curved wall: at 0.60 nearly all seeds with 13 or 20 beads, and some with 30, overlap too
    /// much to be accepted; at 0.55 each of ten is accepted, with any of these numbers.
    double packing_fraction = 0.60;
    int steps = 20000;              ///< of annealing
    double dt = 0.1;                ///< time step of annealing
    double first_noise = 0.2;       ///< s.d. of the random force per step, component; at s = 0
    double noise_decay = 8.0;       ///< it decays as exp(-noise_decay s)
    double first_stiffness = 0.05;  ///< stiffness rises linearly from this to 1, over k_max
    /// Centring force at the wall, over k_max R, times R_box / R: stiffness of centring =
    /// centring (R / R_box)^2. It brings loose beads to the others. With the square, the overlap
    /// that it causes in the middle is about centring / 7 of a diameter for any number of beads.
    double centring = 0.01;
    double force_tolerance = 1e-6;   ///< at the end every bead's force is below this
    int descent_steps_max = 200000;  ///< give up after so many steps of the final descent
    double accepted_overlap = 0.02;  ///< largest accepted mean overlap / diameter
};

/// What a packing is: done and good, or why not.
enum class PackingVerdict {
    unfinished,
    packed,
    unbalanced,   ///< forces above tolerance after descent_steps_max
    overlapping,  ///< mean overlap above what is accepted
};

struct PackingOutcome {
    PackingVerdict verdict = PackingVerdict::unfinished;
    double mean_overlap = 0.0;     ///< mean of overlap / (r_i + r_j) over the pairs that overlap
    double largest_overlap = 0.0;  ///< the same, largest
    double largest_force = 0.0;    ///< over k_max R
    int n_contacts = 0;            ///< pairs that overlap
    std::string reason;            ///< one sentence with what to do; empty when packed
};

enum class PackingPhase : int { annealing = 0, descent = 1, finished = 2 };

/// All that changes while beads are packed; with (radii, parameters, seed) it determines the rest.
struct BeadPackingState {
    PackingPhase phase = PackingPhase::annealing;
    int step = 0;  ///< annealing steps done
    int descent_step = 0;
    double largest_force = 0.0;  ///< at the latest check, in the final descent
    std::vector<Vec3> x;         ///< [n beads] centres over the mean radius
    FireState fire;
};

/// Packs beads into a sphere: random start, annealing (overdamped, noise fades while the beads grow
/// stiff), then FIRE to force balance. Stop after any step, look, save, go on: cutting the run into
/// pieces does not change a bit of the result.
class BeadPacking {
  public:
    /// Radius of the sphere: (sum r^3 / packing_fraction)^(1/3). Throws Error when there are no
    /// radii, one is <= 0, or a parameter is out of range.
    BeadPacking(std::vector<double> radius_um, const BeadPackingParameters& parameters,
                std::uint64_t seed);

    /// Does n_steps steps, fewer if it finishes before.
    void advance(int n_steps);

    [[nodiscard]] bool is_finished() const { return state_.phase == PackingPhase::finished; }
    /// Share of the annealing that is done, 0..1; stays 1 in the final descent, whose length is not
    /// known beforehand (a few hundred to a few thousand steps).
    [[nodiscard]] double progress() const;
    /// Judges the beads as they are now.
    [[nodiscard]] PackingOutcome outcome() const;

    [[nodiscard]] std::span<const Vec3> centre_um() const { return centre_um_; }
    [[nodiscard]] std::span<const double> radius_um() const { return radius_um_; }
    [[nodiscard]] double box_radius_um() const { return box_radius_um_; }

    [[nodiscard]] const BeadPackingState& state() const { return state_; }
    /// Goes on from a saved state of a packing with the same radii, parameters and seed.
    /// Throws Error when its arrays are not those of this many beads.
    void restore(const BeadPackingState& state);

  private:
    [[nodiscard]] BeadForces make_forces() const;
    void start();
    void anneal_step();
    void descent_step();
    void update_centres();

    std::vector<double> radius_um_;
    BeadPackingParameters parameters_;
    std::uint64_t seed_;
    double mean_radius_um_;
    double box_radius_um_;
    BeadForces forces_;
    BeadPackingState state_;
    std::vector<Vec3> force_;
    std::vector<Vec3> centre_um_;
};

}  // namespace spheroscope
