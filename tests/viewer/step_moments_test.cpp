#include "viewer/model/step_moments.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace spheroscope::viewer {
namespace {

StepAnatomy two_terms_and_a_solve() {
    StepAnatomy anatomy;
    anatomy.time_s = 2.5;
    anatomy.node = NodeOfCell{3, 8};
    StepAnatomy::Evaluation evaluation;
    evaluation.contact_pairs = 77;
    StepAnatomy::Term tension{"active tension", 2.0, 0.0, 2.0, 4.0, {1, 6}, {1, 0, 0}, {0, 0, 0}};
    StepAnatomy::Term pressure{"cytosol pressure", 1.5,      2.0, 0.5, 3.0, {0, 2},
                               {-1, 0, 2},         {1, 0, 0}};
    evaluation.terms = {tension, pressure};
    anatomy.phases = {evaluation, SolveHistory{0.1, {1.0, 0.1, 1e-4}, true}};
    anatomy.outcome.accepted = true;
    anatomy.outcome.dt_s = 0.1;
    return anatomy;
}

std::string value_of(const StepMoment& moment, const std::string& what, int nth = 0) {
    for (const TableRow& row : moment.rows)
        if (row.what == what && nth-- == 0) return row.value;
    return "none";
}

TEST(MomentsOfAStep, AreStartEachTermEachSolveAndTheEnd) {
    const StepAnatomy anatomy = two_terms_and_a_solve();
    const std::vector<StepMoment> moments = moments_of(anatomy);
    ASSERT_EQ(moments.size(), 5U);
    EXPECT_EQ(value_of(moments[0], "pairs of triangles in contact"), "77");
    EXPECT_EQ(moments[1].what, "after active tension (1 of 2)");
    EXPECT_EQ(moments[2].what, "after cytosol pressure (2 of 2)");
    EXPECT_EQ(value_of(moments[2], "before"), "2");
    EXPECT_EQ(value_of(moments[2], "after"), "0.5");
    EXPECT_EQ(value_of(moments[2], "after", 1), "(0, 0, 2)");  // on the node
    EXPECT_EQ(value_of(moments[3], "iterations"), "2");
    EXPECT_EQ(value_of(moments[3], "and at the end"), "0.0001");
    ASSERT_NE(moments[3].solve, nullptr);
    EXPECT_EQ(moments[3].solve->residual.size(), 3U);
    EXPECT_EQ(moments[4].what, "the step is good");
}

TEST(MomentsOfAStep, SayWhyItFails) {
    StepAnatomy anatomy = two_terms_and_a_solve();
    anatomy.node.reset();
    anatomy.outcome.accepted = false;
    anatomy.outcome.trouble =
        Trouble{"the linear system of a step could not be solved", "", -1, -1, {}};
    std::get<SolveHistory>(anatomy.phases[1]).converged = false;
    const std::vector<StepMoment> moments = moments_of(anatomy);
    EXPECT_EQ(value_of(moments[3], "converged"), "no");
    EXPECT_EQ(moments.back().what, "the step fails");
    EXPECT_NE(value_of(moments.back(), "reason").find("could not be solved"), std::string::npos);
    EXPECT_EQ(value_of(moments[2], "after", 1), "none");  // no node was asked for
}

}  // namespace
}  // namespace spheroscope::viewer
