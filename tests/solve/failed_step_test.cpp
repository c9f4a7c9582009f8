// A step that cannot be made leaves the state as it was, to the bit, and says why.
#include "engine/solve/step_common.hpp"
#include "tests/reference/made_up_cells.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace spheroscope::test {
namespace {

/// A term that pushes one node, from some evaluation on, without a bound.
class Faulty final : public ForceTerm {
  public:
    Faulty(double force_nN, int cell, int node)
        : ForceTerm(Loc{"faulty.toml", 12, 3}), force_nN_(force_nN), cell_(cell), node_(node) {}
    [[nodiscard]] std::string_view name() const override { return "faulty"; }
    [[nodiscard]] Need needs() const override { return Need::none; }
    void add_force(const Configuration&, int cell, std::span<Vec3> F_nN) const override {
        if (cell == cell_) F_nN[static_cast<std::size_t>(node_)].y() += force_nN_;
    }

  private:
    double force_nN_;
    int cell_, node_;
};

class FailedStep : public testing::TestWithParam<std::string_view> {
  protected:
    static PartValues values() {
        PartValues v = case_a_values();
        v.T_I_s = 0.115;
        v.T_d_s = 1.15;
        return v;
    }
    Cluster cells = make_doublet(42, 7, 5.0, 6.0, 0.2, 0.05);
    State state = state_at(cells.model, cells.x_um);
    MethodParameters parameters = [] {
        MethodParameters p;
        p.dt_s = 1e-3;
        p.linear_tolerance = 1e-6;
        p.loc = {"made_up.toml", 30, 1};
        return p;
    }();

    StepOutcome step(System& system) {
        return find_method(GetParam())->make(parameters)->advance(system, state, 1e9, false);
    }
};

TEST_P(FailedStep, NamesTermCellNodeAndSceneLineOfAForceThatIsNotFinite) {
    for (const double force_nN :
         {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
        SystemParts parts = make_parts(values());
        parts.terms.push_back(std::make_unique<Faulty>(force_nN, 1, 17));
        System system(cells.model, std::move(parts), 2);
        state.volume_integral_s = {0.125, -0.5};
        const std::uint64_t before = state.hash();
        const StepOutcome outcome = step(system);
        EXPECT_FALSE(outcome.accepted);
        ASSERT_TRUE(outcome.trouble);
        EXPECT_EQ(outcome.trouble->term, "faulty");
        EXPECT_EQ(outcome.trouble->cell, 1);
        EXPECT_EQ(outcome.trouble->node, 17);
        EXPECT_EQ(outcome.trouble->text(),
                  "the force is not finite from faulty (faulty.toml:12:3), cell 1, node 17");
        EXPECT_EQ(state.hash(), before);
    }
}

TEST_P(FailedStep, RefusesAForceWhoseSquareIsBeyondAllNumbers) {
    for (const double force_nN : {1e30, 1e160, 1e300}) {
        SystemParts parts = make_parts(values());
        parts.terms.push_back(std::make_unique<Faulty>(force_nN, 1, 17));
        System system(cells.model, std::move(parts), 1);
        const std::uint64_t before = state.hash();
        const StepOutcome outcome = step(system);
        EXPECT_FALSE(outcome.accepted);
        ASSERT_TRUE(outcome.trouble) << force_nN;
        EXPECT_EQ(outcome.trouble->text(), "the force is too large to compute with from faulty "
                                           "(faulty.toml:12:3), cell 1, node 17");
        EXPECT_EQ(state.hash(), before);
    }
}

TEST_P(FailedStep, LeavesTheStateWhenPositionsAreNotFinite) {
    System system(cells.model, make_parts(values()), 1);
    state.x_um[5].x() = std::numeric_limits<double>::quiet_NaN();
    const std::uint64_t before = state.hash();
    const StepOutcome outcome = step(system);
    EXPECT_FALSE(outcome.accepted);
    ASSERT_TRUE(outcome.trouble);
    EXPECT_EQ(outcome.trouble->cell, 0);
    EXPECT_FALSE(outcome.trouble->term.empty());
    EXPECT_EQ(state.hash(), before);
}

TEST_P(FailedStep, CanBeFollowedByAGoodOneWithTheSameSystem) {
    // The evaluation that failed is not taken for the next one's.
    System system(cells.model, make_parts(values()), 1);
    const Vec3 good = state.x_um[5];
    state.x_um[5].x() = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(step(system).accepted);
    state.x_um[5] = good;
    EXPECT_TRUE(step(system).accepted);
    System fresh(cells.model, make_parts(values()), 1);
    const std::uint64_t after = state.hash();
    state = state_at(cells.model, cells.x_um);
    EXPECT_TRUE(step(fresh).accepted);
    EXPECT_EQ(state.hash(), after);
}

INSTANTIATE_TEST_SUITE_P(Methods, FailedStep, testing::ValuesIn([] {
                             std::vector<std::string_view> names;
                             for (const MethodRow& row : all_methods()) names.push_back(row.name);
                             return names;
                         }()),
                         [](const auto& tested) { return std::string(tested.param); });

class AdaptiveStep : public FailedStep {};

TEST_P(AdaptiveStep, RejectedBelowItsSmallestSizeLeavesTheStateBitIdentical) {
    System system(cells.model, make_parts(values()), 2);
    state.wall = {40.0, -1.0, 0.0};
    parameters.tolerance_um = 1e-3;
    ASSERT_TRUE(step(system).accepted);
    ASSERT_TRUE(state.has_velocity) << "so that there is an error estimate";
    const std::uint64_t before = state.hash();
    parameters.tolerance_um = 1e-14;
    parameters.dt_min_s = 1e-5;
    const StepOutcome outcome = step(system);
    EXPECT_FALSE(outcome.accepted);
    EXPECT_GE(outcome.rejected, 2);
    ASSERT_TRUE(outcome.trouble);
    EXPECT_EQ(outcome.trouble->text(),
              "the step size fell below method.dt_min (made_up.toml:30:1)");
    EXPECT_EQ(state.hash(), before);
}

TEST_P(AdaptiveStep, RejectedForItsDisplacementIsMadeSmaller) {
    System system(cells.model, make_parts(values()), 1);
    parameters.tolerance_um = 1.0;
    parameters.dt_s = 0.5;
    parameters.displacement_bound_um = 0.01;
    const StepOutcome outcome = step(system);
    ASSERT_TRUE(outcome.accepted);
    EXPECT_GE(outcome.rejected, 1);
    EXPECT_LT(outcome.dt_s, 0.5);
    EXPECT_LE(outcome.largest_displacement_um, 0.01);
    double largest_um = 0.0;
    for (std::size_t i = 0; i < state.x_um.size(); ++i)
        largest_um = std::max(largest_um, (state.x_um[i] - cells.x_um[i]).norm());
    EXPECT_NEAR(largest_um, outcome.largest_displacement_um, 1e-12);
}

TEST_P(AdaptiveStep, ThatIsAcceptedMeetsItsTolerance) {
    System system(cells.model, make_parts(values()), 1);
    parameters.tolerance_um = 2e-3;
    const auto method = find_method(GetParam())->make(parameters);
    int n_rejected = 0;
    double largest_dt_s = 0.0;
    for (int i = 0; i < 60; ++i) {
        const StepOutcome outcome = method->advance(system, state, 1e9, false);
        ASSERT_TRUE(outcome.accepted);
        EXPECT_LE(outcome.error_um, parameters.tolerance_um);
        EXPECT_LE(outcome.largest_displacement_um, parameters.displacement_bound_um);
        n_rejected += outcome.rejected;
        largest_dt_s = std::max(largest_dt_s, outcome.dt_s);
    }
    EXPECT_GT(largest_dt_s, 10.0 * parameters.dt_s) << "steps grow as the cells come to rest";
    EXPECT_LT(n_rejected, 20);
}

INSTANTIATE_TEST_SUITE_P(Adaptive, AdaptiveStep, testing::ValuesIn([] {
                             std::vector<std::string_view> names;
                             for (const MethodRow& row : all_methods())
                                 if (row.adaptive() && row.order > 0) names.push_back(row.name);
                             return names;
                         }()),
                         [](const auto& tested) { return std::string(tested.param); });

class ForwardEulerStep : public FailedStep {};

TEST_P(ForwardEulerStep, FarAboveItsLimitIsDetectedAndNotFollowed) {
    // 365 /s is the fastest spring mode at E = 320 kPa: steps of up to 5.5 ms hold, 30 ms do not.
    PartValues stiff = values();
    stiff.E_kPa = 320.0;
    System system(cells.model, make_parts(stiff), 1);
    const auto run = [&](double dt_s) {
        parameters.dt_s = dt_s;
        state = state_at(cells.model, cells.x_um);
        const auto method = find_method(GetParam())->make(parameters);
        StepOutcome outcome;
        std::uint64_t before = 0;
        for (int i = 0; i < 60; ++i) {
            before = state.hash();
            outcome = method->advance(system, state, 1e9, false);
            if (!outcome.accepted) break;
        }
        if (!outcome.accepted) {
            EXPECT_EQ(state.hash(), before);
        }
        return outcome;
    };
    EXPECT_TRUE(run(2e-3).accepted);
    const StepOutcome outcome = run(30e-3);
    EXPECT_FALSE(outcome.accepted);
    ASSERT_TRUE(outcome.trouble);
    EXPECT_NE(outcome.trouble->text().find("unstable"), std::string::npos);
    EXPECT_NE(outcome.trouble->text().find("made_up.toml:30:1"), std::string::npos);
    EXPECT_GE(outcome.trouble->cell, 0);
    EXPECT_GE(outcome.trouble->node, 0);
    // The last good state is one of cells, not of an explosion.
    const Geometry geometry = geometry_of(cells.model, state.x_um, Need::volumes);
    for (int cell = 0; cell < 2; ++cell)
        EXPECT_NEAR(geometry.volume_um3[static_cast<std::size_t>(cell)] /
                        cells.model.rest_volume_um3(cell),
                    1.0, 0.2);
}

INSTANTIATE_TEST_SUITE_P(Explicit, ForwardEulerStep, testing::Values("forward_euler"),
                         [](const auto& tested) { return std::string(tested.param); });

TEST(StepEnd, LandsOnTheLimitAndLeavesNoRemainderThatIsTooSmallToBeAStep) {
    EXPECT_EQ(step_end_s(1.0, 0.1, 2.0), 1.1);
    EXPECT_EQ(step_end_s(1.0, 1.5, 2.0), 2.0);
    EXPECT_EQ(step_end_s(1.0, 1.0, 2.0), 2.0);
    EXPECT_EQ(step_end_s(1.0, 0.7, 2.0), 1.5) << "two equal halves, not 0.7 and 0.3";
    EXPECT_EQ(step_end_s(1.0, 1.0 - 1e-12, 2.0), 2.0) << "a rounding error is no step";
    // From any size, the steps to a limit end exactly on it and none is smaller than half the
    // wanted one.
    for (const double dt_s : {0.1, 0.3, 1.0 / 7.0, 0.99, 3.0}) {
        double time_s = 0.25, smallest_s = 10.0;
        int n_steps = 0;
        while (time_s < 3.0 && n_steps < 100) {
            const double end_s = step_end_s(time_s, dt_s, 3.0);
            ASSERT_GT(end_s, time_s);
            if (dt_s < 2.75) smallest_s = std::min(smallest_s, end_s - time_s);
            EXPECT_LE(end_s - time_s, dt_s * (1.0 + 1e-8));
            time_s = end_s;
            ++n_steps;
        }
        EXPECT_EQ(time_s, 3.0);
        EXPECT_GE(smallest_s, 0.499 * dt_s);
    }
}

}  // namespace
}  // namespace spheroscope::test
