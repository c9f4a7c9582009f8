// What a step costs, counted: what a scene does not need costs exactly nothing, and the same scene
// with that part costs what is predicted.
#include "tests/reference/made_up_cells.hpp"
#include "tests/solve/allocation_counter.hpp"

#include <gtest/gtest.h>

namespace spheroscope::test {
namespace {

constexpr int k_steps = 12;
constexpr double k_dt_s = 1e-3;

MethodParameters fixed_steps() {
    MethodParameters p;
    p.dt_s = k_dt_s;
    p.linear_tolerance = 1e-8;
    p.stable_step = StableStep::ignore;  // what the estimate costs is a test of its own
    return p;
}

PartValues drop_values() {
    PartValues v;
    v.gamma_nN_per_um = 0.5;
    v.K_kPa = 5.0;
    return v;
}

Cluster lone_cell(int n_nodes = 42) {
    Cluster cell{make_model(make_icosphere(n_nodes), {6.0}), {}};
    cell.x_um = turned_cells(cell.model, std::vector<Vec3>{Vec3::Zero()}, 1, 0.05);
    return cell;
}

/// The work of some steps by this method.
Work work_of(const char* method_name, const Cluster& cells, const PartValues& values) {
    System system(cells.model, make_parts(values), 2);
    State state = state_at(cells.model, cells.x_um);
    const auto method = find_method(method_name)->make(fixed_steps());
    for (int step = 0; step < k_steps; ++step)
        EXPECT_TRUE(method->advance(system, state, 1e9, false).accepted);
    return system.work();
}

TEST(Work, OfALoneDropIsForcesAndADivision) {
    const Work work = work_of("forward_euler", lone_cell(), drop_values());
    EXPECT_EQ(work.force_evaluations, k_steps);
    EXPECT_EQ(work.evaluations("cortex.tension"), k_steps);
    EXPECT_EQ(work.evaluations("cytosol"), k_steps);
    EXPECT_EQ(work.evaluations("cortex.elastic"), 0);
    EXPECT_EQ(work.stiffness_evaluations, 0);
    EXPECT_EQ(work.contact_searches, 0);
    EXPECT_EQ(work.contact_candidates, 0);
    EXPECT_EQ(work.linear_solves, 0);
    EXPECT_EQ(work.linear_iterations, 0);
    EXPECT_EQ(work.factorisations, 0);
    EXPECT_EQ(work.direct_solves, 0);
}

TEST(Work, WithCortexViscosityIsOneFactorisationForTheWholeRun) {
    PartValues values = drop_values();
    values.eta_kPa_s = 1.0;
    const Work work = work_of("forward_euler", lone_cell(), values);
    EXPECT_EQ(work.factorisations, 1);
    EXPECT_EQ(work.direct_solves, k_steps);
    EXPECT_EQ(work.linear_solves, 0);
    EXPECT_EQ(work.contact_searches, 0);
}

TEST(Work, WithCellsOfDifferentSizeIsOneFactorisationForEachSize) {
    Cluster cells{make_model(make_icosphere(42), {6.0, 5.0, 6.0}), {}};
    cells.x_um = turned_cells(cells.model,
                              std::vector<Vec3>{Vec3::Zero(), Vec3(30, 0, 0), Vec3(0, 30, 0)}, 1);
    PartValues values = drop_values();
    values.eta_kPa_s = 1.0;
    EXPECT_EQ(work_of("forward_euler", cells, values).factorisations, 2);
}

TEST(Work, WithContactsButNoContactFrictionStaysDirect) {
    PartValues values = drop_values();
    values.eta_kPa_s = 1.0;
    values.contact = adhesive_law(0.5, 0.3, 2.0, 0.0);
    const Cluster cells = make_doublet(42, 3, 5.0, 5.0, 0.2);
    const Work work = work_of("forward_euler", cells, values);
    EXPECT_EQ(work.contact_searches, k_steps);
    EXPECT_GT(work.contact_pairs, 0);
    EXPECT_EQ(work.linear_solves, 0);
    EXPECT_EQ(work.direct_solves, k_steps);
}

TEST(Work, WithContactFrictionIsOneIterativeSolvePerStep) {
    PartValues values = drop_values();
    values.eta_kPa_s = 1.0;
    values.contact = adhesive_law(0.5, 0.3, 2.0, 0.0);
    values.contact_friction = ContactFriction{0.05, 0.05};
    const Cluster cells = make_doublet(42, 3, 5.0, 5.0, 0.2);
    const Work work = work_of("forward_euler", cells, values);
    EXPECT_EQ(work.contact_searches, k_steps);
    EXPECT_EQ(work.linear_solves, k_steps);
    EXPECT_GE(work.linear_iterations, k_steps);
    EXPECT_EQ(work.direct_solves, 0);
    EXPECT_EQ(work.factorisations, 1) << "the preconditioner";
}

TEST(Work, OfTheStableStepIsOneStiffnessAndAFewSolvesInAFifthOfASecond) {
    PartValues values = drop_values();
    values.eta_kPa_s = 1.0;
    const Cluster cell = lone_cell();
    System system(cell.model, make_parts(values), 2);
    State state = state_at(cell.model, cell.x_um);
    MethodParameters parameters = fixed_steps();
    parameters.stable_step = StableStep::refuse;
    const auto method = find_method("forward_euler")->make(parameters);
    constexpr int n_steps = 390;  // 0.39 s: at the start and after 0.2 s
    for (int step = 0; step < n_steps; ++step)
        ASSERT_TRUE(method->advance(system, state, 1e9, false).accepted);
    EXPECT_EQ(system.work().force_evaluations, n_steps);
    EXPECT_EQ(system.work().stiffness_evaluations, 2);
    EXPECT_GE(system.work().direct_solves, n_steps + 2 * 7);
    EXPECT_LE(system.work().direct_solves, n_steps + 2 * 20);
}

TEST(Work, OfTheImplicitMethodIsOneStiffnessAndOneSolvePerStep) {
    const Work work = work_of("linearly_implicit", lone_cell(), drop_values());
    EXPECT_EQ(work.force_evaluations, k_steps);
    EXPECT_EQ(work.stiffness_evaluations, k_steps);
    EXPECT_EQ(work.linear_solves, k_steps);
    EXPECT_EQ(work.contact_searches, 0);
    EXPECT_EQ(work.factorisations, 0);
    EXPECT_EQ(work.direct_solves, 0);
}

TEST(Work, OfAStepIsAsManyForceEvaluationsAsTheTableOfMethodsSays) {
    const Cluster doublet = make_doublet(42, 3, 5.0, 5.0, 0.2);
    int n_fixed = 0;
    for (const MethodRow& method : all_methods()) {
        if (method.stages == 0) continue;
        ++n_fixed;
        const std::string name(method.name);
        EXPECT_EQ(work_of(name.c_str(), doublet, case_a_values()).force_evaluations,
                  method.stages * k_steps)
            << name;
    }
    EXPECT_EQ(n_fixed, 4) << "all but rkc, whose stages depend on the length of its step";
}

TEST(Work, OfAnEvaluationIsDoneOnceForTheSameConfiguration) {
    const Cluster cells = make_doublet(42, 3, 5.0, 5.0, 0.2);
    PartValues values = case_a_values();
    System system(cells.model, make_parts(values), 1);
    std::vector<double> integral(2, 0.0);
    ASSERT_FALSE(system.evaluate(cells.x_um, integral, 0.0));
    ASSERT_FALSE(system.evaluate(cells.x_um, integral, 0.0));
    EXPECT_EQ(system.work().force_evaluations, 1);
    integral[1] = 1e-3;
    ASSERT_FALSE(system.evaluate(cells.x_um, integral, 0.0));
    EXPECT_EQ(system.work().force_evaluations, 2);
    EXPECT_EQ(system.work().stiffness_evaluations, 0) << "nobody has asked";
    const auto product = [&](System& of, double dt_s) {
        std::vector<Vec3> out(cells.x_um.size());
        of.velocity_system(dt_s, {}).product(cells.x_um, out, of.workers());
        return out;
    };
    const std::vector<Vec3> friction = product(system, 0.0);
    EXPECT_EQ(system.work().stiffness_evaluations, 0) << "the friction matrix has none";
    const std::vector<Vec3> implicit = product(system, 0.1);
    EXPECT_EQ(product(system, 0.1), implicit);
    EXPECT_EQ(system.work().stiffness_evaluations, 1);
    EXPECT_NE(product(system, 0.2), implicit);
    EXPECT_EQ(system.work().stiffness_evaluations, 2) << "another step is another matrix";
    EXPECT_EQ(product(system, 0.0), friction);
    EXPECT_EQ(system.work().force_evaluations, 2);
    System fresh(cells.model, make_parts(values), 1);
    ASSERT_FALSE(fresh.evaluate(cells.x_um, integral, 0.0));
    EXPECT_EQ(product(fresh, 0.1), implicit);
}

class Allocations : public testing::TestWithParam<std::string_view> {};

TEST_P(Allocations, AreDoneByTheFirstStepsAndThenNeverAgain) {
    if (!counts_allocations()) GTEST_SKIP() << "operator new is the sanitizer's";
    // One thread: each further one makes its own scratch arrays when it first gets a cell.
    const Cluster cell = lone_cell(162);
    PartValues values = drop_values();
    values.E_kPa = 20.0;
    values.bending = true;
    values.eta_kPa_s = 1.0;
    values.T_I_s = 0.115;
    values.T_d_s = 1.15;
    System system(cell.model, make_parts(values), 1);
    State state = state_at(cell.model, cell.x_um);
    const auto method = find_method(GetParam())->make(fixed_steps());
    const std::int64_t at_start = allocations();
    for (int step = 0; step < 3; ++step)
        ASSERT_TRUE(method->advance(system, state, 1e9, false).accepted);
    EXPECT_GT(allocations(), at_start) << "the count is real";
    const std::int64_t before = allocations();
    for (int step = 0; step < k_steps; ++step)
        if (!method->advance(system, state, 1e9, false).accepted) FAIL();
    EXPECT_EQ(allocations() - before, 0);
}

INSTANTIATE_TEST_SUITE_P(Methods, Allocations, testing::ValuesIn([] {
                             std::vector<std::string_view> names;
                             for (const MethodRow& row : all_methods()) names.push_back(row.name);
                             return names;
                         }()),
                         [](const auto& tested) { return std::string(tested.param); });

}  // namespace
}  // namespace spheroscope::test
