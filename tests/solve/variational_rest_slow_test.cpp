// Two soft cells under the law `variational`: they come to rest, and their energy only falls.
#include "engine/forces/fold_stop.hpp"
#include "engine/forces/strain_limiter.hpp"
#include "tests/reference/made_up_cells.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <string>

namespace spheroscope::test {
namespace {

constexpr double k_gamma = 0.5, k_E_kPa = 0.3125, k_W = 0.25;  // nN/um; E t = gamma/8

/// A cell pair of that kind, with the volume controller that has an energy.
class SoftDoublet {
  public:
    SoftDoublet(int n_nodes, std::uint64_t seed)
        : cells_(make_doublet(n_nodes, seed, 9.0, 9.0, -0.1)),
          system_(cells_.model, soft_parts(), 1), state_(state_at(cells_.model, cells_.x_um)) {}

    StepOutcome step(Method& method, double limit_s) {
        return method.advance(system_, state_, limit_s, true);
    }
    double energy_fJ() {
        evaluate();
        return system_.energy_fJ();
    }
    /// RMS of the nodes' forces over the mean force of the cytosol's pressure on a node.
    double residual() {
        evaluate();
        double force2 = 0.0, pressure = 0.0;
        for (const Vec3& F : system_.force_nN()) force2 += F.squaredNorm();
        for (const Vec3& S : system_.geometry().volume_gradient_um2) pressure += S.norm();
        const double P_kPa = system_.parts().cytosol->pressure_kPa(system_.configuration(), 0);
        const auto n = static_cast<double>(system_.force_nN().size());
        return std::sqrt(force2 / n) / (P_kPa * pressure / n);
    }
    [[nodiscard]] double time_s() const { return state_.time_s; }

  private:
    static SystemParts soft_parts() {
        PartValues values = case_a_values();
        values.E_kPa = k_E_kPa;
        values.gamma_nN_per_um = k_gamma;
        values.contact = adhesive_law(k_W, 0.3, 2.0, 0.0);
        values.contact->form = ContactForm::variational;
        SystemParts parts = make_parts(values);
        const double kappa = 0.5 * k_gamma - k_E_kPa * k_thickness_um;
        const Loc loc{"made_up.toml", 8, 1};
        parts.terms.push_back(
            std::make_unique<StrainLimiter>(loc, StrainLimiterParameters{kappa, 0.1}));
        parts.terms.push_back(std::make_unique<FoldStop>(loc, FoldStopParameters{kappa}));
        return parts;
    }
    void evaluate() {
        const auto trouble = system_.evaluate(state_.x_um, state_.volume_integral_s, 0.0);
        ASSERT_FALSE(trouble.has_value()) << trouble->text();
    }

    Cluster cells_;
    System system_;
    State state_;
};

std::unique_ptr<Method> implicit_method(double dt_s, double tolerance_um) {
    MethodParameters parameters;
    parameters.dt_s = dt_s;
    parameters.dt_max_s = 0.3;
    parameters.tolerance_um = tolerance_um;
    parameters.linear_tolerance = 1e-4;
    return find_method("linearly_implicit")->make(parameters);
}

struct Doublet {
    int nodes;
    double end_s;  ///< the rim of a finer mesh settles for longer
};

class Rest : public testing::TestWithParam<Doublet> {};

TEST_P(Rest, IsReachedByTheForcesAndOnTheWayTheEnergyNeverRises) {
    const auto [nodes, end_s] = GetParam();
    SoftDoublet doublet(nodes, 1);
    const auto method = implicit_method(1e-3, 0.006);
    double energy_fJ = doublet.energy_fJ(), largest_rise = 0.0;
    const double start_fJ = energy_fJ;
    while (doublet.time_s() < end_s) {
        ASSERT_TRUE(doublet.step(*method, end_s).accepted);
        const double now_fJ = doublet.energy_fJ();
        largest_rise = std::max(largest_rise, (now_fJ - energy_fJ) / std::abs(energy_fJ));
        energy_fJ = now_fJ;
    }
    std::cout << nodes << " nodes: residual " << doublet.residual() << ", energy " << start_fJ
              << " to " << energy_fJ << " fJ\n";
    EXPECT_LT(doublet.residual(), 1e-3);
    EXPECT_LT(energy_fJ, start_fJ - 5.0) << "it must have spread";
    EXPECT_LE(largest_rise, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Nodes, Rest,
                         testing::Values(Doublet{162, 200.0}, Doublet{642, 200.0},
                                         Doublet{2562, 600.0}),
                         [](const auto& tested) { return std::to_string(tested.param.nodes); });

TEST(PowerBalance, ClosesWithinOnePercentAtOneMillisecond) {
    SoftDoublet doublet(162, 1);
    const auto spread = implicit_method(1e-3, 0.006);
    while (doublet.time_s() < 2.0) ASSERT_TRUE(doublet.step(*spread, 2.0).accepted);
    const auto fine = implicit_method(1e-3, 0.0);
    double energy_fJ = doublet.energy_fJ();
    const double start_fJ = energy_fJ;
    double dissipated_fJ = 0.0;
    for (int step = 0; step < 300; ++step) {
        const StepOutcome outcome = doublet.step(*fine, 10.0);
        ASSERT_TRUE(outcome.accepted);
        dissipated_fJ += outcome.dt_s * outcome.dissipation_nN_um_per_s;
    }
    energy_fJ = doublet.energy_fJ();
    std::cout << "energy " << energy_fJ - start_fJ << " fJ, dissipated " << dissipated_fJ
              << " fJ\n";
    EXPECT_GT(dissipated_fJ, 0.1);
    EXPECT_NEAR(energy_fJ - start_fJ, -dissipated_fJ, 0.01 * dissipated_fJ);
}

}  // namespace
}  // namespace spheroscope::test
