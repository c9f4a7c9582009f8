#pragma once

#include "engine/solve/velocity_system.hpp"

namespace spheroscope {

struct SolveOutcome {
    bool converged = false;
    int iterations = 0;
    double relative_residual = 0.0;  ///< |b - A x| / |b|
};

/// Preconditioned conjugate gradients (Hestenes and Stiefel 1952) on a VelocitySystem, in one
/// parallel region. Dot products are summed per cell, then over cells in index order by every
/// member for itself: no broadcast, and the same bits for any number of threads.
class ConjugateGradients {
  public:
    /// x [all nodes]: start in, solution out. Stops at |b - A x| <= tolerance |b|.
    [[nodiscard]] SolveOutcome solve(const VelocitySystem& system,
                                     const Preconditioner& preconditioner, std::span<const Vec3> b,
                                     std::span<Vec3> x, double tolerance, int largest_iterations,
                                     Workers& workers);

  private:
    std::vector<Vec3> residual_, direction_, product_, preconditioned_;  // [all nodes]
    std::vector<double> sum_bb_, sum_rr_, sum_rz_, sum_pq_;              // [cells]
};

}  // namespace spheroscope
