#pragma once

#include "engine/solve/system.hpp"

#include <span>
#include <vector>

namespace spheroscope {

/// The fastest decay of the linearised motion Gamma u' = -K u: the largest eigenvalue of Gamma^-1 K
/// at the configuration that the system holds, with its stiffness (contacts and volume too). An
/// explicit method is stable up to a multiple of 1/rate: forward Euler to 2/rate.
///
/// Lanczos' iteration (1950) in the inner product of Gamma, always from the same random vector, so
/// that the result depends on nothing but the configuration. One product with K and one friction
/// solve per iteration, to a loose tolerance. A power iteration with warm start was the plan: with
/// many cells hundreds of modes lie within a few percent of the fastest, it needs many more
/// iterations from a cold start, and a warm one would make a run depend on where it was resumed.
class FastestMode {
  public:
    /// The rate, 1/s; from below, to some percent.
    /// Precondition: the system was evaluated.
    [[nodiscard]] double rate_per_s(System& system);

    /// Where the mode of the last rate_per_s() has most of its energy: the term, the cell, and the
    /// edge whose ends move most against each other. `what` and `loc` are left to the caller.
    [[nodiscard]] Trouble place(System& system);

  private:
    static constexpr int k_iterations = 20;

    /// Runs the iteration; with weights [n_iterations] it sums the vectors to mode_.
    void iterate(System& system, std::span<const double> weights);
    /// q_ becomes K q_, from (Gamma + 1 s K) q - Gamma q.
    void multiply_stiffness(System& system);

    std::vector<double> diagonal_, off_diagonal_;  // of the tridiagonal matrix
    std::vector<double> volume_coefficient_;       // [cells]
    std::vector<Vec3> q_, p_, p_before_, r_, z_;   // [all nodes] p = Gamma q
    std::vector<Vec3> mode_;
    double rate_per_s_ = 0.0;
};

}  // namespace spheroscope
