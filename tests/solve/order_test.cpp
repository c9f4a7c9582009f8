#include "tests/reference/made_up_cells.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace spheroscope::test {
namespace {

/// Node positions at 0.1 s by n fixed steps: a stretched cell relaxes, its volume under the full
/// controller.
std::vector<Vec3> end_of_run(const MethodRow& row, int n_steps) {
    PartValues values;
    values.E_kPa = 5.0;
    values.bending = true;
    values.gamma_nN_per_um = 0.5;
    values.K_kPa = 5.0;
    values.T_I_s = 0.115;
    values.T_d_s = 1.15;
    values.eta_kPa_s = 1.0;
    const Model model = make_model(make_icosphere(42), {6.0}, 0.01);
    System system(model, make_parts(values), 1);
    State state = state_at(model, turned_cells(model, std::vector<Vec3>{Vec3::Zero()}, 2));
    for (Vec3& x : state.x_um) x = x.cwiseProduct(Vec3(1.08, 0.97, 0.96));
    MethodParameters parameters;
    constexpr double end_s = 0.1;
    parameters.dt_s = end_s / n_steps;
    parameters.linear_tolerance = 1e-13;
    const auto method = row.make(parameters);
    int n = 0;
    while (state.time_s < end_s) {
        EXPECT_TRUE(method->advance(system, state, end_s, false).accepted);
        ++n;
    }
    EXPECT_EQ(n, n_steps);
    return state.x_um;
}

double distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    double sum2 = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum2 += (a[i] - b[i]).squaredNorm();
    return std::sqrt(sum2 / static_cast<double>(a.size()));
}

TEST(Methods, HaveTheOrderThatTheirTableSays) {
    for (const MethodRow& row : all_methods()) {
        std::vector<std::vector<Vec3>> ends;
        for (const int n_steps : {20, 40, 80, 160}) ends.push_back(end_of_run(row, n_steps));
        // Halving the step divides the difference of two runs by 2^order, up to terms of the next
        // order.
        for (std::size_t i = 0; i + 2 < ends.size(); ++i) {
            const double order =
                std::log2(distance(ends[i], ends[i + 1]) / distance(ends[i + 1], ends[i + 2]));
            EXPECT_NEAR(order, row.order, i == 0 ? 0.2 : 0.1) << row.name;
        }
    }
}

TEST(Methods, GoToTheSameMotion) {
    // Two different first-order methods differ by a multiple of the step only.
    double last_um = 1.0;
    for (const int n_steps : {40, 80, 160}) {
        const double apart_um = distance(end_of_run(*find_method("forward_euler"), n_steps),
                                         end_of_run(*find_method("linearly_implicit"), n_steps));
        EXPECT_LT(apart_um, 0.6 * last_um);
        last_um = apart_um;
    }
    EXPECT_LT(last_um, 2e-3);
}

TEST(Methods, AreFoundByTheirNameOnly) {
    for (const MethodRow& row : all_methods()) EXPECT_EQ(find_method(row.name), &row);
    EXPECT_EQ(find_method("backward_euler"), nullptr);
}

}  // namespace
}  // namespace spheroscope::test
