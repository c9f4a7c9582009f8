// Forces do not depend on where cells are, nor on how everything is turned; numbers of finite
// length make them. This measures by how much.
#include "engine/measures/measure_input.hpp"
#include "engine/measures/totals.hpp"
#include "engine/reports/stability.hpp"
#include "engine/stages/build.hpp"
#include "engine/stages/start_changes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace spheroscope::reports {
namespace {

/// Totals of a configuration alone; those with a small difference of large numbers in them are left
/// out.
constexpr std::array<std::string_view, 5> k_measures{"contact_area", "contact_fraction",
                                                     "sigma_h_size", "smallest_triangle", "energy"};

struct StartForces {
    std::vector<Vec3> force_nN;
    std::vector<double> sigma_h_kPa;
    Totals totals{};
};

StartForces start_forces(const scene::Scene& scene, int threads) {
    const double target_strain = scene.cytosol ? scene.cytosol->target_strain : 0.0;
    Model model =
        make_model(make_icosphere(scene.cells.nodes), cell_radii(scene, {}), target_strain);
    const std::vector<Vec3> x_um = start_positions(scene, model, {});
    const std::vector<double> integral_s(model.radius_um.size(), 0.0);
    System system(std::move(model), build_parts(scene), threads, Need::triangles | Need::volumes);
    const std::optional<Trouble> trouble = system.evaluate(x_um, integral_s, 0.0);
    if (trouble) throw Error(trouble->loc, trouble->text(), "", ExitCode::not_converged);
    StartForces result;
    result.force_nN.assign(system.force_nN().begin(), system.force_nN().end());
    if (scene.contact)
        for (const Mat3& stress : cell_stress_tensors(system.configuration(), system.workers()))
            result.sigma_h_kPa.push_back(stress.trace() / 3.0);
    const Configuration at = system.configuration();
    const std::vector<Vec3> v_um_per_s(x_um.size(), Vec3::Zero());
    MeasureInput input{.at = at,
                       .v_um_per_s = v_um_per_s,
                       .spring_nN_per_um = {},
                       .pressure_kPa = {},
                       .cell_stress_kPa = {}};
    std::vector<Mat3> stress_kPa;
    if (scene.contact) stress_kPa = cell_stress_tensors(at);
    input.cell_stress_kPa = stress_kPa;
    result.totals = compute_totals(input);
    result.totals.energy_fJ = system.energy_fJ();
    return result;
}

}  // namespace

double force_change_by_motion(const scene::Scene& scene, int threads) {
    SPHEROSCOPE_ASSERT(scene.start.has_value(), "a scene with [start]");
    scene::Scene at_home = scene;
    at_home.start->turn_rad = 0.0;
    at_home.start->shift_um = {};
    const StartForces here = start_forces(at_home, threads), there = start_forces(scene, threads);
    const Mat3 back = start_rotation(*scene.start).transpose();
    double change2 = 0.0, size2 = 0.0;
    for (std::size_t i = 0; i < here.force_nN.size(); ++i) {
        change2 += (back * there.force_nN[i] - here.force_nN[i]).squaredNorm();
        size2 += here.force_nN[i].squaredNorm();
    }
    double stress_change2 = 0.0, stress_size2 = 0.0;
    for (std::size_t c = 0; c < here.sigma_h_kPa.size(); ++c) {
        stress_change2 += std::pow(there.sigma_h_kPa[c] - here.sigma_h_kPa[c], 2.0);
        stress_size2 += here.sigma_h_kPa[c] * here.sigma_h_kPa[c];
    }
    double largest = std::sqrt(change2 / size2);
    if (stress_size2 > 0.0) largest = std::max(largest, std::sqrt(stress_change2 / stress_size2));
    for (const std::string_view name : k_measures)
        for (const TotalsRow& row : all_totals()) {
            if (row.name != name) continue;
            const double value = value_of(row, here.totals);
            if (std::abs(value) > 0.0)
                largest = std::max(largest, std::abs(value_of(row, there.totals) / value - 1.0));
        }
    return largest;
}

}  // namespace spheroscope::reports
