#pragma once

#include <vector>

namespace spheroscope {

class System;

/// One linear solve, iteration by iteration.
struct SolveHistory {
    double dt_s = 0.0;             ///< of (Gamma + dt K); 0: friction alone
    std::vector<double> residual;  ///< |b - A v| / |b| at the start, and after each iteration; of a
                                   ///< direct solution nothing
    bool converged = false;
};

/// Sees what a step goes through, in order. Called in the thread that steps; a run has none.
class StepWitness {
  public:
    virtual ~StepWitness() = default;
    /// The system has been evaluated: geometry, contacts and forces are those of this moment.
    virtual void evaluated(System& system) = 0;
    virtual void solved(const SolveHistory& history) = 0;
};

}  // namespace spheroscope
