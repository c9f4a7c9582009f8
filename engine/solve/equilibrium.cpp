// Pseudo-transient continuation (Kelley and Keyes, SIAM J. Numer. Anal. 35, 1998, 508) to a state
// of rest: linearly implicit steps that grow without looking at the error in time. Far from rest
// the friction steers and the step is short; at rest dt K outweighs Gamma, and a step is Newton's
// with the approximate stiffness. Only the end means something: its time is no time.
//
// The step grows by switched evolution relaxation, dt_n = dt_0 |F_0| / |F_n|, here
//
//   dt = 0.3 zeta L / |F_n|     zeta: mean friction of a node, L: displacement bound, |F_n|: RMS
//
// and doubles at most, and no node moves more than L, because the contacts of a step are those of
// its start. Without the first bound steps grow until the rim of a contact, where pairs come and go
// and the force jumps, swings from step to step for ever: two cells of 162 nodes (E = 20 kPa,
// omega = 0.5 nN/um) then stay at |F| = 0.025 nN; with 1 in the place of 0.3 at 0.008, with 0.3 at
// 0.002, and 0.1 takes half as many steps more.
//
// Meant for controller = "exact": the volume is a constraint, and there are no swings of a
// controller to wait for.

#include "engine/solve/equilibrium.hpp"

#include "engine/solve/linearly_implicit.hpp"

namespace spheroscope {
namespace {

MethodParameters without_error(MethodParameters parameters) {
    if (parameters.tolerance_um > 0.0)
        parameters.tolerance_um = std::numeric_limits<double>::infinity();
    return parameters;
}

constexpr double k_forward_part = 0.3;

class Equilibrium final : public LinearlyImplicit {
  public:
    explicit Equilibrium(const MethodParameters& parameters)
        : LinearlyImplicit(without_error(parameters)) {}

  protected:
    [[nodiscard]] double longest_next_step_s(System& system,
                                             const StepOutcome& outcome) const override {
        const VelocitySystem gamma = system.velocity_system(0.0, {});
        double friction = 0.0;  // of all nodes, without contacts
        for (const double drag : gamma.drag_nN_s_per_um) friction += drag;
        friction += 2.0 * gamma.edge_nN_s_per_um *
                    static_cast<double>(system.model().topology->edges.size()) *
                    static_cast<double>(system.model().n_cells());
        const double zeta = friction / static_cast<double>(gamma.drag_nN_s_per_um.size());
        return k_forward_part * zeta * parameters_.displacement_bound_um / outcome.force_rms_nN;
    }
};

}  // namespace

std::unique_ptr<Method> make_equilibrium(const MethodParameters& parameters) {
    return std::make_unique<Equilibrium>(parameters);
}

}  // namespace spheroscope
