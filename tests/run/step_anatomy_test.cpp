// A step taken apart: the terms add up to the force, the solves reach their tolerance, and the
// state is what it was.

#include "engine/base/error.hpp"
#include "engine/run/step_anatomy.hpp"
#include "tests/reference/made_up_cells.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace spheroscope::test {
namespace {

class StepAnatomyOf : public testing::TestWithParam<std::string_view> {
  protected:
    static PartValues values() {
        PartValues v = case_a_values();
        v.contact_friction = ContactFriction{0.07, 0.02};
        return v;
    }
    Cluster cells = make_cluster(42, 3, 0.3, 0.05);
    State state = state_at(cells.model, cells.x_um);
    System system{cells.model, make_parts(values()), 2};

    [[nodiscard]] std::unique_ptr<Method> method() const {
        MethodParameters parameters;
        parameters.dt_s = 2e-3;
        parameters.linear_tolerance = 1e-5;
        if (find_method(GetParam())->adaptive()) parameters.tolerance_um = 2e-3;
        return find_method(GetParam())->make(parameters);
    }
};

TEST_P(StepAnatomyOf, AddsUpTermByTermToTheForceOfTheStep) {
    const NodeOfCell node{2, 17};
    const StepAnatomy anatomy = take_apart(system, *method(), state, 1e9, false, node);
    ASSERT_TRUE(anatomy.outcome.accepted);
    const auto& start = std::get<StepAnatomy::Evaluation>(anatomy.phases.front());
    EXPECT_EQ(start.moved_um, 0.0);
    EXPECT_GT(start.contact_pairs, 10);
    ASSERT_GE(start.terms.size(), 4U);
    Vec3 on_node = Vec3::Zero();
    double before_nN = 0.0;
    for (const StepAnatomy::Term& term : start.terms) {
        EXPECT_EQ(term.before_nN, before_nN) << term.name;
        EXPECT_GE(term.largest_nN, term.rms_nN) << term.name;
        EXPECT_LT((term.on_node_before_nN - on_node).norm(), 1e-12) << term.name;
        before_nN = term.after_nN;
        on_node += term.on_node_nN;
    }
    EXPECT_NEAR(before_nN, anatomy.outcome.force_rms_nN, 1e-12);
    ASSERT_FALSE(system.evaluate(cells.x_um, state.volume_integral_s, 0.0).has_value());
    EXPECT_LT((on_node - system.force_nN()[2 * 42 + 17]).norm(), 1e-12);
}

TEST_P(StepAnatomyOf, HasTheHistoryOfEverySolve) {
    const StepAnatomy anatomy = take_apart(system, *method(), state, 1e9, false, {});
    int n_solves = 0, n_iterations = 0;
    for (const StepAnatomy::Phase& phase : anatomy.phases) {
        const auto* solve = std::get_if<SolveHistory>(&phase);
        if (solve == nullptr) continue;
        ++n_solves;
        EXPECT_TRUE(solve->converged);
        ASSERT_GE(solve->residual.size(), 2U);
        EXPECT_LE(solve->residual.back(), 1e-2);  // some only look for the fastest rate
        EXPECT_LT(solve->residual.back(), solve->residual.front());
        n_iterations += static_cast<int>(solve->residual.size()) - 1;
    }
    EXPECT_GE(n_solves, 1);
    EXPECT_GE(n_iterations, anatomy.outcome.linear_iterations);
    EXPECT_GT(anatomy.outcome.linear_iterations, 0);
}

TEST_P(StepAnatomyOf, IsThatOfTheStepThatFollowsAndChangesNothing) {
    const std::uint64_t before = state.hash();
    const StepAnatomy anatomy = take_apart(system, *method(), state, 1e9, false, {});
    EXPECT_EQ(state.hash(), before);
    State looked_at = state;
    ASSERT_TRUE(method()->advance(system, looked_at, 1e9, false).accepted);
    System other(cells.model, make_parts(values()), 1);
    State alone = state;
    ASSERT_TRUE(method()->advance(other, alone, 1e9, false).accepted);
    EXPECT_EQ(looked_at.hash(), alone.hash());
    double largest_um = 0.0;
    for (std::size_t i = 0; i < alone.x_um.size(); ++i)
        largest_um = std::max(largest_um, (alone.x_um[i] - state.x_um[i]).norm());
    EXPECT_EQ(anatomy.largest_moved_um, largest_um);
    EXPECT_NEAR(anatomy.outcome.dt_s, alone.time_s, 1e-15);
}

TEST_P(StepAnatomyOf, RefusesANodeThatIsNotThere) {
    try {
        static_cast<void>(take_apart(system, *method(), state, 1e9, false, NodeOfCell{1, 42}));
        FAIL() << "nothing was said";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("1:42"), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find("0 to 41"), std::string::npos) << error.what();
    }
}

INSTANTIATE_TEST_SUITE_P(Methods, StepAnatomyOf, testing::ValuesIn([] {
                             std::vector<std::string_view> names;
                             for (const MethodRow& row : all_methods()) names.push_back(row.name);
                             return names;
                         }()),
                         [](const auto& method_case) { return std::string(method_case.param); });

}  // namespace
}  // namespace spheroscope::test
