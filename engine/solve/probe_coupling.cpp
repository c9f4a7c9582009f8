// A probe under a constant force F0 is one more unknown of the motion, its speed w along e:
//
//   zeta w = F0 - F_c,   F_c = sum over the nodes that it touches of k_i d_i (n_i . e)
//
// Its contacts are a thousand times stiffer than the tissue, so its place has to be implicit too.
// With g_i = k_i (n_i . e) n_i and G = sum k_i (n_i . e)^2 the step is
//
//   A v - dt g w = b                    A = Gamma + dt K, with the springs of a standing probe
//   (zeta + dt G) w - dt g.v = F0 - F_c
//
// The textbook elimination, v = A^-1 b + w dt A^-1 g, loses everything: dt G and dt^2 g.A^-1 g are
// equal but for a thousandth. But a translation t of everything along e strains nothing inside, so
//
//   A t = dt g + r,   r = Gamma t + dt K_hull t        =>   dt A^-1 g = t - y,   y = A^-1 r
//   (zeta + dt g.y) w = F0 - F_c + dt g.A^-1 b              v = A^-1 b + w (t - y)
//
// without a difference of large numbers. It costs a second solve in each step, and only while a
// probe touches something. y starts from zero each time, so that a run that goes on from a
// checkpoint does the same steps.

#include "engine/solve/probe_coupling.hpp"

#include <algorithm>
#include <cmath>

namespace spheroscope {

SolveOutcome ProbeCoupling::solve(System& system, const State& state, double dt_s,
                                  std::span<const double> volume_kPa_s_per_um3,
                                  std::span<const Vec3> b, std::vector<Vec3>& v, double tolerance) {
    speed_um_per_s_ = force_nN_ = 0.0;
    SolveOutcome outcome = system.solve_implicit(dt_s, volume_kPa_s_per_um3, b, v, tolerance);
    const Probe& probe = state.load.probe;
    if (!probe.acts() || !outcome.converged) return outcome;
    SPHEROSCOPE_ASSERT(system.parts().probe != nullptr, "the scene of a probe has its term");
    system.parts().probe->find_touches(system.configuration(), touches_);
    for (const auto& touch : touches_) force_nN_ += touch.force_nN * touch.along;
    if (touches_.empty()) {
        speed_um_per_s_ = probe.force_nN / probe.friction_nN_s_per_um;
        return outcome;
    }

    along_.assign(v.size(), probe.direction);
    residue_.resize(v.size());
    system.velocity_system(dt_s, volume_kPa_s_per_um3).product(along_, residue_, system.workers());
    for (const auto& touch : touches_)
        residue_[touch.node] -= dt_s * touch.k_nN_per_um * touch.along * touch.outward;
    give_.assign(v.size(), Vec3::Zero());
    const SolveOutcome second =
        system.solve_implicit(dt_s, volume_kPa_s_per_um3, residue_, give_, tolerance);
    outcome.iterations += second.iterations;
    outcome.converged = second.converged;

    double by_forces = 0.0, by_giving_way = 0.0;
    for (const auto& touch : touches_) {
        const double g = dt_s * touch.k_nN_per_um * touch.along;
        by_forces += g * touch.outward.dot(v[touch.node]);
        by_giving_way += g * touch.outward.dot(give_[touch.node]);
    }
    // Positive for the exact solution; what is not has not converged.
    const double friction = probe.friction_nN_s_per_um + by_giving_way;
    if (!(friction > 0.0)) {
        outcome.converged = false;
        return outcome;
    }
    speed_um_per_s_ = (probe.force_nN - force_nN_ + by_forces) / friction;
    for (std::size_t i = 0; i < v.size(); ++i) v[i] += speed_um_per_s_ * (along_[i] - give_[i]);
    return outcome;
}

double ProbeCoupling::error_um(const State& state, double dt_s) const {
    if (!state.has_velocity) return 0.0;
    return 0.5 * dt_s * std::abs(speed_um_per_s_ - state.load.probe.speed_um_per_s);
}

void ProbeCoupling::finish_step(State& state, double dt_s) const {
    if (!state.load.probe.acts()) return;
    state.load.probe.way_um += dt_s * speed_um_per_s_;
    state.load.probe.speed_um_per_s = speed_um_per_s_;
}

}  // namespace spheroscope
