// Forces do not depend on where cells are, nor on how everything is turned; numbers of finite
// length make them. This measures by how much. One turn may be kind to a mesh by chance, so a scene
// that turns is turned several ways.
#include "engine/base/random.hpp"
#include "engine/forces/in_plane_elasticity.hpp"
#include "engine/measures/fields.hpp"
#include "engine/measures/measure_input.hpp"
#include "engine/measures/pair_forces.hpp"
#include "engine/measures/totals.hpp"
#include "engine/reports/stability.hpp"
#include "engine/stages/build.hpp"
#include "engine/stages/start_changes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <type_traits>

namespace spheroscope::reports {
namespace {

/// Totals of a configuration alone; those with a small difference of large numbers in them are left
/// out.
constexpr std::array<std::string_view, 5> k_measures{"contact_area", "contact_fraction",
                                                     "sigma_h_size", "smallest_triangle", "energy"};

/// Ways in which a scene that turns is turned: its own, and random ones of its seed.
constexpr int k_turns = 6;
/// Distance of two neighbouring numbers in single precision, in which fields are.
constexpr double k_last_bit = 1.2e-7;

struct StartForces {
    std::vector<Vec3> force_nN;
    std::vector<double> sigma_h_kPa, pair_force_nN;
    std::vector<float> gamma_eff_nN_per_um, sigma_nn_kPa;
    Totals totals{};
};

std::vector<double> spring_constants(const scene::Scene& scene, const Model& model) {
    std::vector<double> k_nN_per_um;
    if (!scene.cortex.elastic) return k_nN_per_um;
    const MeshTopology& mesh = *model.topology;
    for (std::size_t e = 0; e < mesh.edges.size(); ++e)
        k_nN_per_um.push_back(k_spring_nN_per_um(
            scene.cortex.elastic->E_kPa, scene.cortex.thickness_um,
            model.unit_triangle_area[static_cast<std::size_t>(mesh.edges[e].left)],
            model.unit_triangle_area[static_cast<std::size_t>(mesh.edges[e].right)],
            model.unit_edge_length[e]));
    return k_nN_per_um;
}

std::vector<float> field_of(const MeasureInput& input, std::string_view name, std::size_t size) {
    std::vector<float> values(size);
    find_field(name)->compute(input, values);
    return values;
}

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
    const Configuration at = system.configuration();
    const std::vector<Vec3> v_um_per_s(x_um.size(), Vec3::Zero());
    const std::vector<double> spring_nN_per_um = spring_constants(scene, at.model);
    std::vector<Mat3> stress_kPa;
    if (scene.contact) stress_kPa = cell_stress_tensors(at, system.workers());
    const MeasureInput input{.at = at,
                             .v_um_per_s = v_um_per_s,
                             .spring_nN_per_um = spring_nN_per_um,
                             .pressure_kPa = {},
                             .cell_stress_kPa = stress_kPa};
    if (scene.cortex.elastic)
        result.gamma_eff_nN_per_um = field_of(input, "gamma_eff", x_um.size());
    // In the law `variational` what a sample presses with goes to one of the triangles around its
    // nearest point; where this is a corner, rounding says which. The forces do not depend on it.
    if (scene.contact && scene.contact->law == scene::ContactLaw::traction)
        result.sigma_nn_kPa = field_of(input, "sigma_nn",
                                       static_cast<std::size_t>(at.model.topology->n_triangles()) *
                                           at.model.radius_um.size());
    if (scene.contact) {
        for (const Mat3& stress : stress_kPa) result.sigma_h_kPa.push_back(stress.trace() / 3.0);
        for (const PairForce& pair : pair_forces(at)) result.pair_force_nN.push_back(pair.force_nN);
    }
    result.totals = compute_totals(input);
    result.totals.energy_fJ = system.energy_fJ();
    return result;
}

/// RMS of the change over RMS of the values; 0 where there are none. What is missing (NaN: no
/// contact) counts as nothing, and numbers in single precision that are neighbours as the same.
template <class Number>
double change_of(const std::vector<Number>& here, const std::vector<Number>& there) {
    SPHEROSCOPE_ASSERT(here.size() == there.size(), "the same cells and pairs");
    const auto number = [](Number value) { return std::isnan(value) ? 0.0 : double{value}; };
    double change2 = 0.0, size2 = 0.0;
    for (std::size_t i = 0; i < here.size(); ++i) {
        const double a = number(here[i]), b = number(there[i]);
        const bool is_same = std::is_same_v<Number, float> &&
                             std::abs(a - b) <= k_last_bit * std::max(std::abs(a), std::abs(b));
        if (!is_same) change2 += (a - b) * (a - b);
        size2 += a * a;
    }
    return size2 > 0.0 ? std::sqrt(change2 / size2) : 0.0;
}

/// The scene's turn for 0, else one about a random axis by a random angle.
scene::Start turned(scene::Start start, std::uint64_t seed, int turn) {
    if (turn == 0) return start;
    const Random random(seed, static_cast<std::uint32_t>(RandomStream::turn));
    const auto index = static_cast<std::uint64_t>(turn);
    for (std::uint32_t k = 0; k < 3; ++k) start.turn_axis[k] = random.normal(index, k);
    start.turn_rad = 2.0 * std::numbers::pi * random.uniform(index, 3);
    return start;
}

/// The largest change of anything between a start that is not moved and one that is.
double change_by(const scene::Scene& moved, const StartForces& here, int threads) {
    const StartForces there = start_forces(moved, threads);
    const Mat3 back = start_rotation(*moved.start).transpose();
    double change2 = 0.0, size2 = 0.0;
    for (std::size_t i = 0; i < here.force_nN.size(); ++i) {
        change2 += (back * there.force_nN[i] - here.force_nN[i]).squaredNorm();
        size2 += here.force_nN[i].squaredNorm();
    }
    double largest =
        std::max({std::sqrt(change2 / size2), change_of(here.sigma_h_kPa, there.sigma_h_kPa),
                  change_of(here.pair_force_nN, there.pair_force_nN),
                  change_of(here.gamma_eff_nN_per_um, there.gamma_eff_nN_per_um),
                  change_of(here.sigma_nn_kPa, there.sigma_nn_kPa)});
    for (const std::string_view name : k_measures) {
        const TotalsRow& row = *find_total(name);
        const double value = value_of(row, here.totals);
        if (std::abs(value) > 0.0)
            largest = std::max(largest, std::abs(value_of(row, there.totals) / value - 1.0));
    }
    return largest;
}

}  // namespace

double force_change_by_motion(const scene::Scene& scene, int threads) {
    SPHEROSCOPE_ASSERT(scene.start.has_value(), "a scene with [start]");
    scene::Scene at_home = scene;
    at_home.start->turn_rad = 0.0;
    at_home.start->shift_um = {};
    const StartForces here = start_forces(at_home, threads);
    double largest = 0.0;
    const int n_turns = scene.start->turn_rad != 0.0 ? k_turns : 1;
    for (int turn = 0; turn < n_turns; ++turn) {
        scene::Scene moved = scene;
        moved.start = turned(*scene.start, scene.seed, turn);
        largest = std::max(largest, change_by(moved, here, threads));
    }
    return largest;
}

}  // namespace spheroscope::reports
