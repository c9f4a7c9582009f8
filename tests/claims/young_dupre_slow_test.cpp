// Young and Dupre: where two cells adhere with work of adhesion W, tensions of gamma outside and
// gamma - W/2 on either side of the contact balance at cos theta = 1 - W / 2 gamma.
//
// The claim holds for a range of adhesion that is small against the cell. At h0 = 0.3 um the rim,
// which adhesion pulls together over a gap of 2 h0, widens the contact: by 0.02 in cos theta for
// W = gamma/4 on every mesh, by a quarter of that at half the range. scenes/claims/README.md has
// the table.
//
// The paper's force (law `traction`) has no part along the surface, and another balance: where the
// zone of adhesion at the rim is thin, sin^2 theta / cos theta = W / T, T the tension of the free
// membrane.
#include "tests/claims/doublet_shape.hpp"
#include "tests/claims/scene_run.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <numbers>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace spheroscope::test {
namespace {

constexpr double k_R0_um = 9.0, k_gamma_nN_per_um = 0.5;

/// Means over seeds of a doublet at rest.
struct RestingDoublet {
    double cos_theta = 0.0;
    double cap_radius_um = 0.0;
    double disc_radius_um = 0.0;
    double pressure_kPa = 0.0;
    /// Of the free membrane, which is a sphere: Young and Laplace.
    [[nodiscard]] double tension_nN_per_um() const { return 0.5 * pressure_kPa * cap_radius_um; }
};

RestingDoublet mean_over_seeds(const std::string& scene, std::vector<scene::Override> overrides,
                               int n_seeds) {
    RestingDoublet mean;
    std::string name = scene;
    for (const scene::Override& change : overrides) name += " " + change.key + "=" + change.value;
    overrides.push_back({"scene.seed", ""});
    for (int seed = 1; seed <= n_seeds; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        overrides.back().value = std::to_string(seed);
        const SceneRun run = run_scene(scene, overrides);
        EXPECT_EQ(run.result.verdict, RunVerdict::finished) << run.result.message;
        EXPECT_EQ(run.last().totals.n_flipped_triangles, 0);
        const DoubletShape shape = doublet_shape(run.last());
        mean.cos_theta += shape.cos_theta / n_seeds;
        mean.cap_radius_um += shape.cap_radius_um / n_seeds;
        mean.disc_radius_um += std::sqrt(shape.disc_area_um2 / std::numbers::pi) / n_seeds;
        mean.pressure_kPa += run.last().totals.mean_pressure_kPa / n_seeds;
    }
    std::cout << name << ", " << n_seeds << " seeds: cos theta " << mean.cos_theta << ", R_cap/R0 "
              << mean.cap_radius_um / k_R0_um << ", a/R0 " << mean.disc_radius_um / k_R0_um
              << ", T/gamma " << mean.tension_nN_per_um() / k_gamma_nN_per_um << "\n";
    return mean;
}

RestingDoublet of_half(int nodes, int n_seeds) {
    return mean_over_seeds("claims/young_dupre_half.toml", {{"cells.nodes", std::to_string(nodes)}},
                           n_seeds);
}

RestingDoublet of_quarter(int nodes, const std::string& h0, int n_seeds) {
    return mean_over_seeds(
        "claims/young_dupre_quarter.toml",
        {{"cells.nodes", std::to_string(nodes)}, {"contact.h0", "\"" + h0 + "\""}}, n_seeds);
}

RestingDoublet of_one(int nodes, int n_seeds) {
    return mean_over_seeds(
        "claims/young_dupre_half.toml",
        {{"cells.nodes", std::to_string(nodes)}, {"contact.adhesion.W", "\"0.5 nN/um\""}}, n_seeds);
}

/// Two caps with the volume of two spheres of R0: R_cap / R0.
double cap_over_R0(double cos_theta) {
    return std::cbrt(4.0 / (2.0 + 3.0 * cos_theta - cos_theta * cos_theta * cos_theta));
}

/// C-15, row 2: two caps of the cells' volume on one disc, of the angle that theory says, and a
/// free membrane that carries gamma alone. The disc's radius goes with the angle's error over
/// tan^2.
void expect_caps_of_the_cells_volume(const RestingDoublet& doublet, double cos_theta,
                                     double tolerance_of_disc) {
    const auto disc_over_R0 = [](double c) { return cap_over_R0(c) * std::sqrt(1.0 - c * c); };
    EXPECT_NEAR(doublet.cap_radius_um / k_R0_um, cap_over_R0(cos_theta), 0.01);
    EXPECT_NEAR(doublet.disc_radius_um / k_R0_um / disc_over_R0(cos_theta), 1.0, tolerance_of_disc);
    EXPECT_NEAR(doublet.tension_nN_per_um() / k_gamma_nN_per_um, 1.0, 0.01);
}

TEST(YoungDupre, HoldsForAWorkOfAdhesionOfHalfTheTensionAndTheErrorFallsWithTheMesh) {
    const RestingDoublet coarse = of_half(162, 3), fine = of_half(642, 2),
                         finest = of_half(2562, 1);
    EXPECT_NEAR(coarse.cos_theta, 0.75, 0.03);
    EXPECT_NEAR(fine.cos_theta, 0.75, 0.02);
    EXPECT_NEAR(finest.cos_theta, 0.75, 0.008);
    EXPECT_LT(std::abs(fine.cos_theta - 0.75), std::abs(coarse.cos_theta - 0.75));
    EXPECT_LT(std::abs(finest.cos_theta - 0.75), std::abs(coarse.cos_theta - 0.75));
    expect_caps_of_the_cells_volume(fine, 0.75, 0.012);
    expect_caps_of_the_cells_volume(finest, 0.75, 0.012);
}

TEST(YoungDupre, HoldsForAWorkOfAdhesionOfAQuarterOfTheTensionAndTheErrorFallsWithTheRange) {
    const RestingDoublet wide = of_quarter(642, "0.3 um", 2),
                         narrow = of_quarter(642, "0.15 um", 2);
    EXPECT_NEAR(wide.cos_theta, 0.875, 0.03);
    EXPECT_NEAR(narrow.cos_theta, 0.875, 0.01);
    EXPECT_LT(std::abs(narrow.cos_theta - 0.875), std::abs(wide.cos_theta - 0.875));
    const RestingDoublet finest_wide = of_quarter(2562, "0.3 um", 1),
                         finest_narrow = of_quarter(2562, "0.15 um", 1);
    EXPECT_NEAR(finest_wide.cos_theta, 0.875, 0.03);
    EXPECT_NEAR(finest_narrow.cos_theta, 0.875, 0.01);
    EXPECT_LT(std::abs(finest_narrow.cos_theta - 0.875), std::abs(finest_wide.cos_theta - 0.875));
    expect_caps_of_the_cells_volume(finest_narrow, 0.875, 0.03);
}

// The wedge at the rim is steep here. The angle stands at 0.61 instead of 0.5, on every mesh and
// from larger contacts as well as from smaller ones; without the strain limiter it is 0.57, but
// then triangles shrink to a fifth of the mean. scenes/claims/README.md.
TEST(YoungDupre, IsMissedByATenthForAWorkOfAdhesionOfTheTension) {
    for (const auto& [nodes, n_seeds] :
         {std::pair(162, 3), std::pair(642, 2), std::pair(2562, 1)}) {
        const RestingDoublet doublet = of_one(nodes, n_seeds);
        EXPECT_NEAR(doublet.cos_theta, 0.5, 0.15) << nodes;
        EXPECT_NEAR(doublet.cos_theta, 0.61, 0.02) << nodes;
        expect_caps_of_the_cells_volume(doublet, doublet.cos_theta, 0.03);
    }
}

TEST(ThinZone, OfThePapersForceBalancesAtItsOwnAngleAndTheErrorFallsWithTheMesh) {
    for (const auto& [scene, W_nN_per_um] :
         {std::pair("claims/doublet_i.toml", 0.25), std::pair("claims/doublet_ii.toml", 0.5)}) {
        double before = 1.0;
        for (const auto& [nodes, n_seeds, tolerance] :
             {std::tuple(642, 2, 0.06), std::tuple(2562, 1, 0.04)}) {
            const RestingDoublet doublet = mean_over_seeds(
                scene, {{"cells.nodes", std::to_string(nodes)}, {"contact.reject_cos", "0.8"}},
                n_seeds);
            const double w = W_nN_per_um / doublet.tension_nN_per_um();
            const double thin_zone = 0.5 * (std::sqrt(w * w + 4.0) - w);
            const double young_dupre = 1.0 - 0.5 * w;
            std::cout << "  thin zone " << thin_zone << ", Young-Dupre " << young_dupre << "\n";
            const double error = std::abs(doublet.cos_theta - thin_zone);
            EXPECT_LT(error, tolerance);
            EXPECT_LT(error, before);
            EXPECT_LT(error, std::abs(doublet.cos_theta - young_dupre));
            before = error;
        }
    }
}

}  // namespace
}  // namespace spheroscope::test
