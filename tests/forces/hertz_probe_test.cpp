// The probe with Hertz's law, beside the linear one that every_term_test.cpp tests.
#include "engine/forces/cell_stiffness.hpp"
#include "engine/forces/indenting_probe.hpp"
#include "tests/forces/test_cell.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace spheroscope::test {
namespace {

const IndentingProbe& hertz() {
    static const IndentingProbe probe({}, {.k_kPa_per_um = 27.8, .hertz_modulus_kPa = 20.0});
    return probe;
}

/// Above the cell, so deep in it; the other cell, of 7 um, is not reached.
void place_probe(TestCell& cell, double depth_um) {
    cell.load.probe.start_um = Vec3(0.0, 0.0, 9.0 + 27.0 - depth_um);
    cell.load.probe.way_um = 0.0;
}

TEST(HertzProbe, PressesASphereWithHertzsForceOfItsDepth) {
    TestCell cell(2562);
    const double R_eff_um = 1.0 / (1.0 / 27.0 + 1.0 / 9.0);
    for (const double depth_um : {0.5, 1.0, 1.8}) {
        place_probe(cell, depth_um);
        const double expected = 4.0 / 3.0 * 20.0 * std::sqrt(R_eff_um) * std::pow(depth_um, 1.5);
        const double got = -hertz().sum_nN(cell.at()).z();
        // The overlap of two spheres has the sum pi R_eff d^3 / 3 up to d/R, and pushes along its
        // normals, not along z; a shallow one is of few facets.
        EXPECT_NEAR(got / expected, 1.0, depth_um < 1.0 ? 0.1 : 0.05) << depth_um;
    }
}

TEST(HertzProbe, IsTheGradientOfItsEnergy) {
    TestCell cell(162);
    cell.shake(5, 0.1);
    place_probe(cell, 1.8);
    const std::vector<Vec3> F = cell.force_nN(hertz());
    std::size_t n_touched = 0;
    const double h_um = 1e-5;
    for (std::size_t i = 0; i < cell.n_nodes(); ++i)
        for (int k = 0; k < 3; ++k) {
            const Vec3 kept = cell.x()[i];
            cell.x()[i][k] = kept[k] + h_um;
            const double above = cell.energy_fJ(hertz());
            cell.x()[i][k] = kept[k] - h_um;
            const double below = cell.energy_fJ(hertz());
            cell.x()[i] = kept;
            EXPECT_NEAR(F[i][k], -(above - below) / (2.0 * h_um), 1e-6 * norm(F));
            if (F[i][k] != 0.0) ++n_touched;
        }
    EXPECT_GT(n_touched, 3U) << "more than one node";
}

TEST(HertzProbe, DoesNotJumpWhenANodeBeginsToTouch) {
    TestCell cell(162);
    double before_nN = 0.0;
    for (double depth_um = -0.5; depth_um < 2.0; depth_um += 1e-3) {
        place_probe(cell, depth_um);
        const double now_nN = -hertz().sum_nN(cell.at()).z();
        // dF/dd of Hertz's law is 147 nN/um at the end. A node with the uniform pressure of that
        // law would bring 10 nN.
        EXPECT_NEAR(now_nN, before_nN, 0.5) << depth_um;
        before_nN = now_nN;
    }
    EXPECT_GT(before_nN, 100.0);
}

TEST(HertzProbe, HasAStiffnessThatIsNoLessThanThatOfItsForce) {
    TestCell cell(162);
    place_probe(cell, 1.5);
    CellStiffness K;
    hertz().add_stiffness(cell.at(), TestCell::cell, K);
    std::vector<IndentingProbe::Touch> touches;
    hertz().find_touches(cell.at(), touches);
    ASSERT_GT(touches.size(), 2U);
    ASSERT_EQ(K.nodes.size(), touches.size());
    // The probe a little further: the force grows by no more than the stiffness along its way says.
    const double h_um = 1e-4;
    double expected = 0.0;
    for (const auto& touch : touches) expected += touch.k_nN_per_um * touch.along * touch.along;
    const double before = -hertz().sum_nN(cell.at()).z();
    cell.load.probe.way_um += h_um;
    const double slope = (-hertz().sum_nN(cell.at()).z() - before) / h_um;
    EXPECT_GT(slope, 0.0);
    EXPECT_LT(slope, 1.02 * expected);
}

}  // namespace
}  // namespace spheroscope::test
