// The largest stable step of the explicit method: steps above it are refused by name before they
// bounce the cells apart, which they would do with finite numbers.
#include "engine/solve/fastest_mode.hpp"
#include "tests/reference/dense_system.hpp"
#include "tests/reference/made_up_cells.hpp"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

namespace spheroscope::test {
namespace {

constexpr double k_paper_dt_s = 3.849e-3;

PartValues stiff_values(double E_kPa, const ContactLaw& law) {
    PartValues values = case_a_values();
    values.E_kPa = E_kPa;
    values.T_I_s = 0.115;
    values.T_d_s = 1.15;
    values.contact = law;
    return values;
}

MethodParameters steps_of(double dt_s, StableStep stable_step = StableStep::refuse) {
    MethodParameters parameters;
    parameters.dt_s = dt_s;
    parameters.stable_step = stable_step;
    parameters.loc = {"made_up.toml", 30, 1};
    return parameters;
}

struct Ending {
    StepOutcome last;
    State state;
    double contact_area_um2 = 0.0;
};
/// Two cells of 162 nodes whose surfaces are 0.2 um apart.
Ending doublet_run(const PartValues& values, const MethodParameters& parameters, double end_s) {
    const Cluster cells = make_doublet(162, 7, 9.0, 9.0, -0.2);
    System system(cells.model, make_parts(values), 1);
    Ending run;
    run.state = state_at(cells.model, cells.x_um);
    const auto method = find_method("forward_euler")->make(parameters);
    run.last = advance_until(*method, system, run.state, end_s);
    for (const Contacts::Group& group : system.contacts().groups)
        for (const ContactPair& pair : Contacts::pairs_of(group))
            run.contact_area_um2 += pair.area_um2;
    return run;
}

TEST(StableStep, IsTheFastestModeOfTheDenseMatrices) {
    const Cluster cells = make_doublet(42, 3, 5.0, 6.0, 0.3, 0.05);
    System system(cells.model, make_parts(stiff_values(20.0, adhesive_law(0.5, 0.3, 2.0, 0.0))), 1);
    ASSERT_FALSE(system.evaluate(cells.x_um, std::vector<double>(2, 0.0), 0.0));
    const VelocitySystem gamma = system.velocity_system(0.0, system.volume_friction());
    const Eigen::MatrixXd dense_gamma = reference::dense_product(gamma, system.workers());
    std::vector<double> coefficient;
    for (const double target_um3 : cells.model.target_volume_um3)
        coefficient.push_back(5.0 * (1.0 + 1.15) / target_um3);
    const Eigen::MatrixXd dense_K =
        reference::dense_product(system.velocity_system(1.0, coefficient), system.workers()) -
        dense_gamma;
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(
        0.5 * (dense_K + dense_K.transpose()), 0.5 * (dense_gamma + dense_gamma.transpose()),
        Eigen::EigenvaluesOnly);
    const double exact_per_s = modes.eigenvalues().maxCoeff();
    FastestMode mode;
    const double rate_per_s = mode.rate_per_s(system);
    EXPECT_LE(rate_per_s, 1.005 * exact_per_s);
    EXPECT_GE(rate_per_s, 0.97 * exact_per_s);
    EXPECT_EQ(mode.rate_per_s(system), rate_per_s) << "the same configuration, the same bits";
}

TEST(StableStep, OfStiffSpringsIsRefusedWithCellAndEdge) {
    for (const double E_kPa : {640.0, 1280.0}) {
        const Ending run = doublet_run(stiff_values(E_kPa, adhesive_law(0.5, 0.3, 2.0, 0.0)),
                                       steps_of(k_paper_dt_s), 0.2);
        EXPECT_FALSE(run.last.accepted);
        ASSERT_TRUE(run.last.trouble);
        EXPECT_EQ(run.last.trouble->term, "cortex.elastic");
        EXPECT_GE(run.last.trouble->cell, 0);
        EXPECT_NE(run.last.trouble->node, run.last.trouble->neighbour);
        const std::string text = run.last.trouble->text();
        EXPECT_NE(text.find("unstable: the step of 3.849 ms is above"), std::string::npos) << text;
        EXPECT_NE(text.find("(made_up.toml:30:1), cell "), std::string::npos) << text;
        EXPECT_NE(text.find(", edge "), std::string::npos) << text;
    }
}

TEST(StableStep, OfThePaperHoldsItsStiffestCortex) {
    const Ending run = doublet_run(stiff_values(320.0, adhesive_law(0.5, 0.3, 2.0, 0.0)),
                                   steps_of(k_paper_dt_s), 0.3);
    EXPECT_TRUE(run.last.accepted);
}

TEST(StableStep, OfContactsIsRefusedWhereCellsWouldBounceApart) {
    // The law as printed, P0 = omega/h0 and k = omega/h0^2. Left alone the cells end apart, with
    // finite numbers and no trouble.
    for (const auto& [omega, dt_s] : {std::pair(1.0, 20e-3), std::pair(0.5, 40e-3)}) {
        const PartValues values = stiff_values(0.3125, adhesive_law(0.5 * omega, 0.3, 1.0, 0.0));
        const Ending refused = doublet_run(values, steps_of(dt_s), 0.2);
        ASSERT_TRUE(refused.last.trouble) << omega;
        EXPECT_EQ(refused.last.trouble->term, "contact");
        const Ending held = doublet_run(values, steps_of(0.25 * dt_s), 2.0);
        EXPECT_TRUE(held.last.accepted);
        EXPECT_GT(held.contact_area_um2, 10.0);
    }
}

TEST(StableStep, IsFollowedWithoutANumberFromTheScene) {
    const PartValues values = stiff_values(640.0, adhesive_law(0.5, 0.3, 2.0, 0.0));
    MethodParameters parameters = steps_of(1.0, StableStep::follow);
    const Ending run = doublet_run(values, parameters, 0.3);
    ASSERT_TRUE(run.last.accepted) << run.last.trouble->text();
    EXPECT_GT(run.state.fastest_rate_per_s, 600.0);
    const int n_steps = static_cast<int>(0.3 * run.state.fastest_rate_per_s / 1.6);
    EXPECT_NEAR(run.last.dt_s, 0.3 / n_steps, 0.5 * 0.3 / n_steps);
    parameters.dt_max_s = 1e-3;
    EXPECT_LE(doublet_run(values, parameters, 0.02).last.dt_s, 1e-3);
}

}  // namespace
}  // namespace spheroscope::test
