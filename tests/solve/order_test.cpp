#include "tests/reference/made_up_cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

namespace spheroscope::test {
namespace {

double distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    double sum2 = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum2 += (a[i] - b[i]).squaredNorm();
    return std::sqrt(sum2 / static_cast<double>(a.size()));
}

/// A motion, and how long it is followed.
struct Problem {
    Cluster cells;
    PartValues values;
    State start;
    double duration_s;
    std::vector<int> steps;
};

/// A stretched cell relaxes, its volume under the full controller; friction that never changes but
/// for the volume.
Problem lone_cell_problem() {
    PartValues values = case_a_values();
    values.E_kPa = 5.0;
    values.T_I_s = 0.115;
    values.T_d_s = 1.15;
    values.contact.reset();
    values.contact_friction.reset();
    Cluster cell{make_model(make_icosphere(42), {6.0}, 0.01), {}};
    cell.x_um = turned_cells(cell.model, std::vector<Vec3>{Vec3::Zero()}, 2);
    for (Vec3& x : cell.x_um) x = x.cwiseProduct(Vec3(1.08, 0.97, 0.96));
    const State start = state_at(cell.model, cell.x_um);
    return {cell, values, start, 0.1, {20, 40, 80, 160}};
}

/// Two cells in contact on their way to rest: the friction matrix changes with the contacts, the
/// integral is on. The time is so short that no pair of triangles comes or goes.
const Problem& doublet_problem() {
    static const Problem problem = [] {
        PartValues values = case_a_values();
        values.T_I_s = 0.115;
        values.T_d_s = 1.15;
        Cluster cells = make_doublet(42, 7, 5.0, 6.0, 0.4);
        System system(cells.model, make_parts(values), 1);
        State start = state_at(cells.model, cells.x_um);
        MethodParameters parameters;
        parameters.dt_s = 1e-3;
        parameters.linear_tolerance = 1e-10;
        const auto method = find_method("linearly_implicit")->make(parameters);
        EXPECT_TRUE(advance_until(*method, system, start, 0.5).accepted);
        start.has_velocity = false;
        start.time_s = 0.0;
        return Problem{cells, values, start, 0.02, {8, 16, 32, 64}};
    }();
    return problem;
}

/// The same two cells from the moment on in which they touch: pairs of triangles come all the time.
Problem spreading_problem() {
    PartValues values = case_a_values();
    values.T_I_s = 0.115;
    values.T_d_s = 1.15;
    const Cluster cells = make_doublet(42, 7, 5.0, 6.0, -0.55);
    return {cells, values, state_at(cells.model, cells.x_um), 1.0, {40, 80, 160, 320}};
}

std::vector<Vec3> end_of_run(const Problem& problem, const MethodRow& row, int n_steps) {
    System system(problem.cells.model, make_parts(problem.values), 1);
    State state = problem.start;
    MethodParameters parameters;
    parameters.dt_s = problem.duration_s / n_steps;
    parameters.linear_tolerance = 1e-13;
    const auto method = row.make(parameters);
    int n = 0;
    while (state.time_s < problem.duration_s) {
        const StepOutcome outcome = method->advance(system, state, problem.duration_s, false);
        if (!outcome.accepted) {
            ADD_FAILURE() << row.name << ": " << outcome.trouble->text();
            break;
        }
        ++n;
    }
    EXPECT_EQ(n, n_steps);
    return state.x_um;
}

/// Halving the step divides the difference of two runs by 2^order, up to terms of the next order.
std::vector<double> observed_orders(const Problem& problem, const MethodRow& row) {
    std::vector<std::vector<Vec3>> ends;
    for (const int n_steps : problem.steps) ends.push_back(end_of_run(problem, row, n_steps));
    std::vector<double> orders;
    for (std::size_t i = 0; i + 2 < ends.size(); ++i)
        orders.push_back(
            std::log2(distance(ends[i], ends[i + 1]) / distance(ends[i + 1], ends[i + 2])));
    return orders;
}

class Order : public testing::TestWithParam<std::string_view> {};

TEST_P(Order, OfALoneCellsMotionIsThatOfTheTable) {
    const MethodRow& row = *find_method(GetParam());
    const std::vector<double> orders = observed_orders(lone_cell_problem(), row);
    EXPECT_NEAR(orders[0], row.order, 0.2);
    EXPECT_NEAR(orders[1], row.order, 0.15);
}

TEST_P(Order, OfADoubletsMotionWithChangingFrictionIsThatOfTheTable) {
    const MethodRow& row = *find_method(GetParam());
    const std::vector<double> orders = observed_orders(doublet_problem(), row);
    EXPECT_NEAR(orders[0], row.order, 0.15);
    EXPECT_NEAR(orders[1], row.order, 0.15);
}

// Pairs that come add kinks to the motion: their area grows from nothing, so the force is
// continuous and only its slope jumps. The order suffers in long steps and comes back in short
// ones.
TEST_P(Order, AcrossContactEventsComesNearThatOfTheTable) {
    const MethodRow& row = *find_method(GetParam());
    const Problem problem = spreading_problem();
    const std::vector<double> orders = observed_orders(problem, row);
    std::cout << row.name << ": order " << orders[0] << ", " << orders[1] << "\n";
    EXPECT_NEAR(orders[0], row.order, 0.5);
    EXPECT_NEAR(orders[1], row.order, 0.25);

    System system(problem.cells.model, make_parts(problem.values), 1);
    const auto pairs_at = [&](const std::vector<Vec3>& x_um) {
        EXPECT_FALSE(system.evaluate(x_um, problem.start.volume_integral_s, 0.0));
        return system.contacts().groups.at(0).pairs.size();
    };
    EXPECT_GT(pairs_at(end_of_run(problem, row, 40)), 2 * pairs_at(problem.start.x_um));
}

INSTANTIATE_TEST_SUITE_P(Methods, Order, testing::ValuesIn([] {
                             std::vector<std::string_view> names;
                             for (const MethodRow& row : all_methods())
                                 if (row.order > 0) names.push_back(row.name);
                             return names;
                         }()),
                         [](const auto& tested) { return std::string(tested.param); });

TEST(OrderOfADoublet, IsMeasuredWhereFrictionChangesAndNoPairComesOrGoes) {
    const Problem& problem = doublet_problem();
    System system(problem.cells.model, make_parts(problem.values), 1);
    const auto pairs_at = [&](const std::vector<Vec3>& x_um) {
        EXPECT_FALSE(system.evaluate(x_um, problem.start.volume_integral_s, 0.0));
        return system.contacts().groups.at(0).pairs;
    };
    const auto before = pairs_at(problem.start.x_um);
    const auto after =
        pairs_at(end_of_run(problem, *find_method("linearly_implicit"), problem.steps.back()));
    ASSERT_GT(before.size(), 20U);
    ASSERT_EQ(before.size(), after.size());
    double largest_change = 0.0, friction_before = 0.0, friction_after = 0.0;
    for (std::size_t i = 0; i < before.size(); ++i) {
        EXPECT_EQ(before[i].triangle_a, after[i].triangle_a);
        EXPECT_EQ(before[i].triangle_b, after[i].triangle_b);
        friction_before += before[i].area_um2;
        friction_after += after[i].area_um2;
        largest_change =
            std::max(largest_change, std::abs(after[i].area_um2 / before[i].area_um2 - 1.0));
    }
    EXPECT_GT(largest_change, 0.01);
    EXPECT_NE(friction_before, friction_after);
}

TEST(Methods, GoToTheSameMotion) {
    // What two methods differ by falls with the lower of their orders.
    const Problem problem = lone_cell_problem();
    const MethodRow& first = all_methods().front();
    for (const MethodRow& row : all_methods().subspan(1)) {
        if (row.order == 0) continue;
        double last_um = 1.0;
        for (const int n_steps : {40, 80, 160}) {
            const double apart_um =
                distance(end_of_run(problem, first, n_steps), end_of_run(problem, row, n_steps));
            EXPECT_LT(apart_um, 0.6 * last_um) << row.name;
            last_um = apart_um;
        }
        EXPECT_LT(last_um, 2e-3) << row.name;
    }
}

TEST(Methods, AreFoundByTheirNameOnly) {
    for (const MethodRow& row : all_methods()) EXPECT_EQ(find_method(row.name), &row);
    EXPECT_EQ(find_method("backward_euler"), nullptr);
}

}  // namespace
}  // namespace spheroscope::test
