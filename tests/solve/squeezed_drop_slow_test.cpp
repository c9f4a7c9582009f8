// A drop of tension gamma between two rigid frictionless plates. Young and Laplace: the free
// surface has one mean curvature, P = gamma (1/R1 + 1/R2), and touches the plates at 180 degrees,
// so the plates carry F = P pi a^2. With kappa = P/2 gamma the balance of a cap is
//
//   r sin(psi) = kappa (r^2 - a^2)        psi: slope of the meridian, 0 at the plate, 90 deg at the
//                                         equator
// which gives r(psi), and height and volume by quadrature.
#include "engine/solve/equilibrium.hpp"
#include "tests/reference/made_up_cells.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace spheroscope::test {
namespace {

constexpr double k_gamma = 0.5, k_R_um = 9.0;

struct Drop {
    double half_height, volume;  ///< in units of 1/kappa
};

Drop drop_with_contact_radius(double a) {
    Drop drop{0.0, 0.0};
    constexpr int n = 4000;
    for (int k = 0; k < n; ++k) {
        const double psi = (k + 0.5) * 0.5 * std::numbers::pi / n;
        const double root = std::sqrt(std::pow(std::sin(psi), 2) + 4.0 * a * a);
        const double r = 0.5 * (std::sin(psi) + root);
        const double dz =
            0.5 * std::sin(psi) * (1.0 + std::sin(psi) / root) * 0.5 * std::numbers::pi / n;
        drop.half_height += dz;
        drop.volume += 2.0 * std::numbers::pi * r * r * dz;
    }
    return drop;
}

struct Squeezed {
    double pressure_kPa, force_nN;
};

/// The drop of this volume between plates at +- this height, by bisection for kappa a.
Squeezed exact(double volume_um3, double half_height_um) {
    double low = 1e-6, high = 10.0;
    const double wanted = half_height_um / std::cbrt(volume_um3);
    for (int k = 0; k < 100; ++k) {
        const double a = 0.5 * (low + high);
        const Drop drop = drop_with_contact_radius(a);
        (drop.half_height / std::cbrt(drop.volume) > wanted ? low : high) = a;
    }
    const Drop drop = drop_with_contact_radius(low);
    const double kappa = std::cbrt(drop.volume / volume_um3);
    const double P = 2.0 * k_gamma * kappa;
    return {P, P * std::numbers::pi * std::pow(low / kappa, 2)};
}

TEST(SqueezedDrop, ExactSolutionHasTheLimitOfASphere) {
    const double volume = 4.0 / 3.0 * std::numbers::pi * std::pow(k_R_um, 3);
    const Squeezed sphere = exact(volume, 0.9999 * k_R_um);
    EXPECT_NEAR(sphere.pressure_kPa, 2.0 * k_gamma / k_R_um, 1e-4);
    EXPECT_LT(sphere.force_nN, 0.05);
}

/// The drop on a mesh, at rest between two planes of a hull.
Squeezed on_mesh(int n_nodes, double half_height_um) {
    PartValues values;
    values.gamma_nN_per_um = k_gamma;
    values.K_kPa = values.T_I_s = 1.0;
    values.exact_volume = true;
    values.eta_kPa_s = 1.0;
    SystemParts parts = make_parts(values);
    auto plates = std::make_unique<ConfiningHull>(Loc{}, ConfiningHullParameters{30.0});
    const ConfiningHull& term = *plates;
    parts.hull = plates.get();
    parts.terms.push_back(std::move(plates));
    System system(make_model(make_icosphere(n_nodes), {k_R_um}), std::move(parts), 1,
                  Need::triangles | Need::volumes);
    std::vector<Vec3> x_um;
    for (const Vec3& x : system.model().topology->unit_shape) x_um.push_back(k_R_um * x);
    State state = state_at(system.model(), x_um);
    Hull planes;
    planes.planes = {{Vec3::UnitZ(), half_height_um}, {-Vec3::UnitZ(), half_height_um}};
    state.load.hull = std::make_shared<const Hull>(std::move(planes));
    MethodParameters parameters;
    parameters.dt_s = 1e-3;
    parameters.dt_max_s = 1.0;
    parameters.tolerance_um = 1.0;
    parameters.displacement_bound_um = 0.1;
    parameters.linear_tolerance = 1e-4;
    const auto method = make_equilibrium(parameters);
    double force_nN = 0.0;
    for (int step = 0; step < 400; ++step) {
        const StepOutcome outcome = method->advance(system, state, 1e9, false);
        EXPECT_TRUE(outcome.accepted);
        if (!outcome.accepted) break;
        double sum_nN = 0.0;
        for (const Vec3& f : system.force_of_term(term)) sum_nN += 0.5 * std::abs(f.z());
        const bool is_at_rest = outcome.force_rms_nN < 1e-4 && std::abs(sum_nN - force_nN) < 1e-4;
        force_nN = sum_nN;
        if (is_at_rest) break;
    }
    EXPECT_FALSE(system.evaluate(state.x_um, state.volume_integral_s, 0.0, state.load));
    return {system.parts().cytosol->pressure_kPa(system.configuration(), 0), force_nN};
}

TEST(SqueezedDrop, CarriesThePlatesWithItsPressureTimesTheAreaThatTheyTouch) {
    const double volume = 4.0 / 3.0 * std::numbers::pi * std::pow(k_R_um, 3);
    for (const double half_height_um : {8.1, 7.2, 6.0}) {
        const Squeezed wanted = exact(volume, half_height_um);
        for (const int n_nodes : {642, 2562}) {
            if (n_nodes == 2562 && half_height_um != 7.2) continue;
            const Squeezed got = on_mesh(n_nodes, half_height_um);
            std::cout << n_nodes << " nodes, plates at +-" << half_height_um
                      << " um: P = " << got.pressure_kPa << " kPa (" << wanted.pressure_kPa
                      << "), F = " << got.force_nN << " nN (" << wanted.force_nN << ")\n";
            EXPECT_NEAR(got.pressure_kPa / wanted.pressure_kPa, 1.0, 0.03);
            EXPECT_NEAR(got.force_nN / wanted.force_nN, 1.0, 0.03);
        }
    }
}

}  // namespace
}  // namespace spheroscope::test
