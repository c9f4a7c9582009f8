#include "tests/figures/made_up_runs.hpp"

#include <cmath>

namespace spheroscope::test {

statistics::RunStatistics made_up_run(double gamma_over_omega, double Et_over_omega,
                                      std::uint64_t seed) {
    const double step = 0.01 * static_cast<double>(seed);
    statistics::RunStatistics run;
    run.file = "run_" + std::to_string(seed) + ".h5";
    run.seed = seed;
    run.version = "1";
    run.outcome = "rest";
    run.stage_name = "relax";
    run.R_th_um = 50.0;
    run.extent_um = 55.0;
    statistics::Setup& setup = run.setup;
    setup.scene_without_seed =
        std::to_string(gamma_over_omega) + " " + std::to_string(Et_over_omega);
    setup.title = "Made up";
    setup.gamma_over_omega = gamma_over_omega;
    setup.Et_over_omega = Et_over_omega;
    setup.gamma_nN_per_um = 0.5;
    setup.thickness_um = 0.2;
    setup.omega_nN_per_um = 0.5 / gamma_over_omega;
    setup.W_nN_per_um = setup.omega_nN_per_um;
    setup.E_kPa = Et_over_omega * setup.omega_nN_per_um / 0.2;
    setup.n_cells = 100;
    setup.n_nodes = 162;
    setup.law = "traction";
    setup.omega_reading = "text";
    run.totals.eps_YL_omega = 0.5 + 0.1 * gamma_over_omega + step;
    run.totals.eps_YL_W = 0.1 * gamma_over_omega + step;
    run.totals.coordination_Z = 12.0;
    run.totals.smallest_triangle = 0.6;
    for (int i = 0; i < 2400; ++i) {
        const double r = (i + 0.5) / 2000.0;
        run.sigma_h_nearest_kPa.push_back({r, r - 0.6 + step});
        run.sigma_h_smooth_kPa.push_back({r, r - 0.6});
        run.voids.push_back({r, r > 1.0 ? 1.0 : 0.0});
        for (auto& samples : run.cell_stress_kPa) samples.push_back({r, 0.2 + step});
    }
    run.tension_nN_per_um = {0.1 + step, 0.05, 0.01, 0.2};
    run.equal_kPa.assign(100, {-0.1, 0.05 + step, 1.5, 0.3});
    run.area_kPa.assign(100, {-0.2, 0.04, 1.4, 0.28});
    // Quantiles of an exponential law.
    for (int i = 0; i < 600; ++i)
        run.pairs.push_back({i % 100, 100, -std::log((i + 0.5) / 600.0), 5.0});
    run.load = {
        {1.0, 0.5, 5.0, 4.9, 0.02}, {2.0, 1.0, 10.0, 9.9, 0.01}, {3.0, 1.5, 15.0, 15.0, 0.0}};
    return run;
}

}  // namespace spheroscope::test
