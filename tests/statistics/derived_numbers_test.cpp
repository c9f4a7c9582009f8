#include "engine/statistics/derived_numbers.hpp"
#include "tests/statistics/made_up_aggregate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace spheroscope::statistics {
namespace {

/// A core cell in the middle that touches something, and six cells far away that touch nothing, all
/// with one tension on the core cell's surface and another on theirs.
Aggregate core_and_rim(double inside_nN_per_um, double outside_nN_per_um) {
    std::vector<Vec3> centres{Vec3::Zero()};
    for (const Vec3& axis : {Vec3(1.0, 0.0, 0.0), Vec3(0.0, 1.0, 0.0), Vec3(0.0, 0.0, 1.0)})
        for (const double distance : {-1000.0, 1000.0}) centres.emplace_back(distance * axis);
    Aggregate aggregate = test::round_cells(centres, 9.0, 42);
    const std::size_t n = aggregate.topology->unit_shape.size();
    for (std::size_t i = 0; i < aggregate.x_um.size(); ++i)
        aggregate.gamma_eff_nN_per_um[i] = i < n ? inside_nN_per_um : outside_nN_per_um;
    std::fill_n(aggregate.sigma_nn_kPa.begin(), aggregate.topology->triangles.size(), 1.0);
    aggregate.R_th_um = 50.0;
    return aggregate;
}

RunStatistics run_of(const Aggregate& aggregate, double sigma_h_core_kPa) {
    RunStatistics run;
    run.setup.law = "traction";
    run.tension_nN_per_um = tension_by_region(aggregate);
    run.totals.R_th_um = aggregate.R_th_um;
    run.totals.sigma_h_core_kPa = sigma_h_core_kPa;
    return run;
}

const SetupNumber* find(const std::vector<SetupNumber>& numbers, const std::string& name) {
    const auto at = std::find_if(numbers.begin(), numbers.end(),
                                 [&](const SetupNumber& number) { return number.name == name; });
    return at == numbers.end() ? nullptr : &*at;
}

TEST(CoreOver2GammaR, IsOneForADropletAndThePressureOverItsForOthers) {
    // Gamma = 0.2 nN/um on a sphere of 50 um: 0.008 kPa
    const Aggregate aggregate = core_and_rim(0.1, 0.3);
    ASSERT_TRUE(aggregate.is_core(0));
    ASSERT_FALSE(aggregate.is_core(1));
    SetupStatistics setup;
    setup.runs = {run_of(aggregate, -0.008), run_of(aggregate, -0.004),
                  run_of(core_and_rim(0.3, 0.1), -0.008)};
    const std::vector<SetupNumber> numbers = numbers_of(setup);
    const SetupNumber* ratio = find(numbers, "core_over_2Gamma_R");
    ASSERT_NE(ratio, nullptr);
    EXPECT_NEAR(ratio->by_run[0], 1.0, 1e-12);
    EXPECT_NEAR(ratio->by_run[1], 0.5, 1e-12);
    EXPECT_NEAR(ratio->by_run[2], -1.0, 1e-12) << "a surface that pulls less than the inside";
    EXPECT_NEAR(ratio->estimate.mean, 0.5 / 3.0, 1e-12);
    EXPECT_EQ(ratio->estimate.n, 3);
}

TEST(CoreOver2GammaR, IsThereOnceAndOnlyWhereItsPartsAreAndItMeansSomething) {
    SetupStatistics setup;
    setup.runs = {run_of(core_and_rim(0.1, 0.3), -0.008)};
    std::vector<SetupNumber> numbers = numbers_of(setup);
    const std::size_t n = numbers.size();
    add_derived_numbers(numbers, "traction");
    EXPECT_EQ(numbers.size(), n);
    std::erase_if(numbers, [](const SetupNumber& number) {
        return number.name == "core_over_2Gamma_R" || number.name == "gamma_eff, core";
    });
    add_derived_numbers(numbers, "traction");
    EXPECT_EQ(find(numbers, "core_over_2Gamma_R"), nullptr);
    setup.runs.front().setup.law = "variational";
    EXPECT_EQ(find(numbers_of(setup), "core_over_2Gamma_R"), nullptr);
}

TEST(StressOfLayers, IsTheMeanOverTheCellsOfEach) {
    SetupStatistics setup;
    setup.runs.emplace_back();
    RunStatistics& run = setup.runs.front();
    const auto cell = [](double anisotropic_mean_kPa) {
        return CellStress{0.0, 0.0, 0.0, anisotropic_mean_kPa};
    };
    run.equal_kPa = {cell(0.1), cell(0.2), cell(0.4), cell(std::nan(""))};
    run.area_kPa = run.equal_kPa;
    run.is_core = {1, 0, 0, 1};
    const std::vector<SetupNumber> numbers = numbers_of(setup);
    EXPECT_NEAR(find(numbers, "mean_anisotropic_stress, core cells")->estimate.mean, 100.0, 1e-9)
        << "a cell that touches nothing has none";
    EXPECT_NEAR(find(numbers, "mean_anisotropic_stress, rim cells")->estimate.mean, 300.0, 1e-9);
}

}  // namespace
}  // namespace spheroscope::statistics
