#pragma once

#include "engine/forces/indenting_probe.hpp"
#include "engine/solve/system.hpp"

#include <vector>

namespace spheroscope {

/// The linear system of one implicit step with the probe's speed w as one more unknown; see
/// probe_coupling.cpp. Without a probe it is System::solve_implicit and nothing more.
class ProbeCoupling {
  public:
    /// Solves for v [all nodes] (in: where to start from) and the probe's speed. The system holds
    /// an evaluation, with stiffness, of the state's load.
    [[nodiscard]] SolveOutcome solve(System& system, const State& state, double dt_s,
                                     std::span<const double> volume_kPa_s_per_um3,
                                     std::span<const Vec3> b, std::vector<Vec3>& v,
                                     double tolerance);

    /// What the last solution says of the probe; 0 without one.
    [[nodiscard]] double speed_um_per_s() const { return speed_um_per_s_; }
    /// dt/2 |w - w before|: by how much a step of order 1 is wrong about its way, um.
    [[nodiscard]] double error_um(const State& state, double dt_s) const;
    /// Power that the moving probe puts into its contacts.
    [[nodiscard]] double power_nN_um_per_s() const { return force_nN_ * speed_um_per_s_; }
    /// Moves the state's probe by an accepted step.
    void finish_step(State& state, double dt_s) const;

  private:
    std::vector<IndentingProbe::Touch> touches_;
    std::vector<Vec3> along_, residue_, give_;  // [all nodes]
    double speed_um_per_s_ = 0.0, force_nN_ = 0.0;
};

}  // namespace spheroscope
