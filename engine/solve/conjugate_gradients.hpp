#pragma once

#include "engine/base/huge_vector.hpp"
#include "engine/solve/cellwise_inverse.hpp"

namespace spheroscope {

struct SolveOutcome {
    bool converged = false;
    int iterations = 0;
    double relative_residual = 0.0;  ///< |b - A x| / |b|
};

/// Preconditioned conjugate gradients (Hestenes and Stiefel 1952) on a VelocitySystem, in one
/// parallel region. The iterations are done in single precision, on the correction to the start: a
/// product reads half as much and does three components in one instruction. The residual that they
/// start from is computed in double precision; where more digits are asked for than single
/// precision has, the iterations are started again from the residual of what has been reached
/// (iterative refinement, Wilkinson 1963). So any tolerance can be had, down to that of double
/// precision.
///
/// Dot products are summed per cell, then over cells in index order by every member for itself: no
/// broadcast, and the same bits for any number of threads.
class ConjugateGradients {
  public:
    /// x [all nodes]: start in, solution out. Stops at |b - A x| <= tolerance |b|.
    [[nodiscard]] SolveOutcome solve(const VelocitySystem& system,
                                     const Preconditioner& preconditioner, std::span<const Vec3> b,
                                     std::span<Vec3> x, double tolerance, int largest_iterations,
                                     Workers& workers);
    /// From now on every solve also writes |r| / |b| of its iterations here, replacing what stands
    /// there; nullptr: no longer.
    void record_residuals(std::vector<double>* residuals) { residuals_ = residuals; }

  private:
    class Solve;
    HugeVector<Vec3> exact_product_;                                                  // [all nodes]
    HugeVector<Lanes> correction_, residual_, direction_, product_, preconditioned_;  // likewise
    std::vector<double> sum_bb_, sum_rr_, sum_rz_, sum_pq_;                           // [cells]
    std::vector<double> sum_r_;  // [3 cells] force on each cell, for RigidMotions
    struct Translations {
        std::vector<double> of_cells, work;  // [3 cells]
    };
    std::vector<Translations> translations_;  // [members] each finds them for itself
    std::vector<double>* residuals_ = nullptr;
};

}  // namespace spheroscope
