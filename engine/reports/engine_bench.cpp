// What the parts of a step cost. Wall time on a machine that does other things says little, so
// every time comes with the CPU time of the process, and the least of several repetitions counts.
// Between repetitions all nodes move by a tenth of a nanometre: an evaluation of the same
// bits would be free, and lists of candidates would be rebuilt after larger motions.

#include "engine/reports/engine_bench.hpp"

#include "engine/contact/contact_timing.hpp"
#include "engine/contact/triangle_pair.hpp"
#include "engine/reports/machine.hpp"
#include "engine/stages/build.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace spheroscope::reports {
namespace {

constexpr double k_radius_um = 9.0;
constexpr double k_overlap_um = 0.7;
constexpr double k_wiggle_um = 1e-4;
constexpr double k_solve_dt_s = 0.05;
constexpr double k_solve_tolerance = 1e-3;
constexpr int k_hashed_steps = 4;

constexpr const char* k_scene = R"(
[cells]
arrangement = "centres"
centres = [[0, 0, 0, 9]]
[cortex.elastic]
E = "20 kPa"
[cortex.bending]
[cortex.tension]
gamma = "0.5 nN/um"
[cortex.viscosity]
eta = "1 kPa s"
[cytosol]
[medium]
[[stage]]
kind = "relax"
duration = "1 s"
)";

constexpr const char* k_contact = R"(
[contact]
[contact.adhesion]
omega = "0.5 nN/um"
[contact.friction]
normal = "0.05 kPa s/um"
tangential = "0.05 kPa s/um"
)";

/// The lattice points next to the origin, face-centred cubic, nearest first; ties in the order of
/// their coordinates, so that the set is the same everywhere.
std::vector<Vec3> lattice_um(int n_cells, double distance_um) {
    const int reach = static_cast<int>(std::ceil(std::cbrt(static_cast<double>(n_cells)))) + 2;
    std::vector<std::array<int, 4>> points;
    for (int i = -reach; i <= reach; ++i)
        for (int j = -reach; j <= reach; ++j)
            for (int k = -reach; k <= reach; ++k)
                if ((i + j + k) % 2 == 0) points.push_back({i * i + j * j + k * k, i, j, k});
    std::sort(points.begin(), points.end());
    std::vector<Vec3> centres;
    for (int c = 0; c < n_cells; ++c) {
        const auto& p = points[static_cast<std::size_t>(c)];
        centres.emplace_back(distance_um / std::sqrt(2.0) * Vec3(p[1], p[2], p[3]));
    }
    return centres;
}

scene::Scene scene_of(const BenchSize& size, scene::Precision precision) {
    std::string text = k_scene;
    if (size.cells > 1) text += k_contact;
    // one cell has nothing to touch, and a scene with contact wants two
    std::vector<scene::Override> changes{{"cells.nodes", std::to_string(size.nodes)}};
    std::string rows;
    for (const Vec3& c : lattice_um(size.cells, 2.0 * k_radius_um - k_overlap_um))
        rows += (rows.empty() ? "[" : ", [") + std::to_string(c.x()) + ", " +
                std::to_string(c.y()) + ", " + std::to_string(c.z()) + ", " +
                std::to_string(k_radius_um) + "]";
    changes.push_back({"cells.centres", "[" + rows + "]"});
    scene::Scene scene = scene::parse_scene(text, "bench", changes);
    if (scene.contact) scene.contact->precision = precision;
    return scene;
}

/// The least of several times of `work`, which gets the number of the repetition.
template <class Work> BenchTime least_time(const Repetitions& repetitions, const Work& work) {
    BenchTime best{std::numeric_limits<double>::infinity(),
                   std::numeric_limits<double>::infinity()};
    for (Repetitions::Count count(repetitions); count.goes_on();) {
        const double wall_s = wall_clock_s(), cpu_s = cpu_clock_s();
        work(count.n_begun() - 1);
        best.wall_ms = std::min(best.wall_ms, 1e3 * (wall_clock_s() - wall_s));
        best.cpu_ms = std::min(best.cpu_ms, 1e3 * (cpu_clock_s() - cpu_s));
    }
    return best;
}

/// Largest difference of a nodal force of the contact kernel in use to the plain one in double,
/// over the largest nodal force.
double contact_force_error(const System& system, std::span<const Vec3> x_um) {
    const Model& model = system.model();
    const MeshTopology& mesh = *model.topology;
    const auto corners = [&](int cell, int triangle) {
        const std::span<const Vec3> x = model.cell_nodes(x_um, cell);
        const auto& t = mesh.triangles[static_cast<std::size_t>(triangle)];
        TriangleGeometry geometry;
        for (std::size_t k = 0; k < 3; ++k)
            geometry.corner_um[k] = x[static_cast<std::size_t>(t[k])];
        geometry.normal = (geometry.corner_um[1] - geometry.corner_um[0])
                              .cross(geometry.corner_um[2] - geometry.corner_um[0])
                              .normalized();
        return geometry;
    };
    double difference = 0.0, largest = 0.0;
    for (const Contacts::Group& group : system.contacts().groups)
        for (const ContactPair& pair : Contacts::pairs_of(group)) {
            ContactPair plain{};
            const PairOutcome outcome = contact_of_triangles(corners(group.cell_a, pair.triangle_a),
                                                             corners(group.cell_b, pair.triangle_b),
                                                             *system.parts().contact, plain);
            if (outcome != PairOutcome::active) plain = ContactPair{};
            for (std::size_t k = 0; k < 3; ++k) {
                largest =
                    std::max({largest, std::abs(pair.force_a_nN[k]), std::abs(pair.force_b_nN[k])});
                difference =
                    std::max({difference, std::abs(pair.force_a_nN[k] - plain.force_a_nN[k]),
                              std::abs(pair.force_b_nN[k] - plain.force_b_nN[k])});
            }
        }
    return largest > 0.0 ? difference / largest : std::numeric_limits<double>::quiet_NaN();
}

/// Geometry, contact search and every force term by itself.
void time_parts(System& system, std::span<const std::vector<Vec3>, 2> x_um,
                const Repetitions& repetitions, BenchRow& row) {
    const Model& model = system.model();
    Geometry geometry;
    geometry.allocate(model, system.needs());
    const auto x_of = [&](int k) -> const std::vector<Vec3>& {
        return x_um[static_cast<std::size_t>(k % 2)];
    };
    row.terms.push_back({"geometry", least_time(repetitions, [&](int k) {
                             for (int cell = 0; cell < model.n_cells(); ++cell)
                                 geometry.compute_cell(model, x_of(k), system.needs(), cell);
                         })});
    if (system.parts().contact)
        row.contact = time_contacts(model, x_um[0], *system.parts().contact,
                                    system.parts().contact_precision, repetitions);
    const Configuration at = system.configuration();
    std::vector<Vec3> F(model.n_all_nodes(), Vec3::Zero());
    for (const auto& term : system.parts().terms)
        row.terms.push_back({std::string(term->name()), least_time(repetitions, [&](int) {
                                 for (int cell = 0; cell < model.n_cells(); ++cell)
                                     term->add_force(at, cell,
                                                     model.cell_nodes(std::span<Vec3>(F), cell));
                             })});
}

void time_solve(System& system, const Repetitions& repetitions, BenchRow& row) {
    const std::vector<Vec3> b(system.force_nN().begin(), system.force_nN().end());
    std::vector<Vec3> v(b.size());
    row.solve_dt_s = k_solve_dt_s;
    const std::span<const double> coefficient = system.volume_friction();
    row.solve = least_time(repetitions, [&](int) {
        std::fill(v.begin(), v.end(), Vec3::Zero());  // a cold start: the same work each time
        row.solve_iterations =
            system.solve_implicit(k_solve_dt_s, coefficient, b, v, k_solve_tolerance).iterations;
    });
    std::vector<Vec3> product(b.size());
    system.velocity_system(k_solve_dt_s, coefficient).product(v, product, system.workers());
    double residual2 = 0.0, size2 = 0.0;
    for (std::size_t i = 0; i < b.size(); ++i) {
        residual2 += (b[i] - product[i]).squaredNorm();
        size2 += b[i].squaredNorm();
    }
    row.solve_residual = std::sqrt(residual2 / size2);
}

/// Raises largest_MB to what is allocated while the method is there.
BenchStep time_steps(const scene::Scene& scene, const MethodRow& method, System& system,
                     std::span<const Vec3> x_um, const Repetitions& repetitions,
                     double& largest_MB) {
    BenchStep result;
    result.method = method.name;
    State state;
    state.x_um.assign(x_um.begin(), x_um.end());
    state.v_um_per_s.assign(x_um.size(), Vec3::Zero());
    state.volume_integral_s.assign(system.model().radius_um.size(), 0.0);
    const auto stepper = method.make(method_parameters(scene));
    int n_steps = 0;
    const auto make_step = [&] {
        if (!result.message.empty()) return;
        const StepOutcome outcome = stepper->advance(system, state, state.time_s + 1.0, false);
        if (!outcome.accepted) result.message = outcome.trouble->text();
        if (++n_steps > k_hashed_steps) return;  // more are timed where they are short
        result.dt_s = outcome.dt_s;
        result.error_um = outcome.error_um;
        result.linear_iterations = outcome.linear_iterations;
        result.state_hash = state.hash();
    };
    // Before their first step explicit methods look for the largest stable one: ten steps' time.
    make_step();
    result.time = least_time(repetitions, [&](int) { make_step(); });
    while (n_steps < k_hashed_steps && result.message.empty() && !repetitions.is_stopped())
        make_step();
    largest_MB = std::max(largest_MB, allocated_MB());
    return result;
}

}  // namespace

std::vector<BenchSize> bench_sizes(BenchExtent extent) {
    const bool is_quick = extent == BenchExtent::quick;
    std::vector<BenchSize> sizes;
    for (const int nodes : {162, 642})
        for (const int cells : {1, 13, 55, 75, 150, 600})
            for (const int threads : {1, 2})
                if (!is_quick || (cells <= 55 && nodes * cells <= 55 * 162))
                    sizes.push_back({cells, nodes, threads});
    return sizes;
}

std::optional<BenchRow> run_bench(const BenchSize& size, const BenchOptions& options) {
    const Repetitions& repetitions = options.repetitions;
    const scene::Scene scene = scene_of(size, options.precision);
    BenchRow row;
    row.size = size;
    const double memory_before_MB = allocated_MB();
    double largest_MB = memory_before_MB;
    Model model = make_model(make_icosphere(size.nodes), cell_radii(scene, {}));
    std::array<std::vector<Vec3>, 2> x_um;
    x_um[0] = x_um[1] = start_positions(scene, model, {});
    for (Vec3& x : x_um[1]) x.x() += k_wiggle_um;
    const std::vector<double> integral_s(model.radius_um.size(), 0.0);
    System system(std::move(model), build_parts(scene), size.threads);
    const auto evaluate = [&](int k) {
        const auto trouble =
            system.evaluate(x_um[static_cast<std::size_t>(k % 2)], integral_s, 0.0);
        if (trouble) throw Error(trouble->loc, trouble->text(), "", ExitCode::not_converged);
    };
    evaluate(1);  // lists and memory are made here
    row.force = least_time(repetitions, [&](int k) { evaluate(k); });
    row.stiffness = least_time(repetitions, [&](int k) {
        evaluate(k);
        static_cast<void>(system.velocity_system(k_solve_dt_s, {}));
    });
    evaluate(0);
    row.force_error = size.cells > 1 ? contact_force_error(system, x_um[0])
                                     : std::numeric_limits<double>::quiet_NaN();
    time_solve(system, repetitions, row);
    time_parts(system, std::span<const std::vector<Vec3>, 2>(x_um), repetitions, row);
    for (const MethodRow& method : all_methods())
        if (method.moves_in_time())  // the system has a controller, which is a motion in time
            row.steps.push_back(
                time_steps(scene, method, system, x_um[0], repetitions, largest_MB));
    if (repetitions.is_stopped()) return std::nullopt;
    row.memory_MB = largest_MB - memory_before_MB;
    return row;
}

}  // namespace spheroscope::reports
