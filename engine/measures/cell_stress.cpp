#include "engine/base/index.hpp"
#include "engine/forces/contact_variational.hpp"
#include "engine/measures/measure_input.hpp"

#include <array>

namespace spheroscope {
namespace {

/// Where a pair's own virial is taken from. Its forces sum to zero, so any point does; one at the
/// pair keeps the digits.
const Vec3& origin_of_pair(const Configuration& at, const Contacts::Group& group,
                           const ContactPair& pair) {
    const int node = at.model.topology->triangles[idx(pair.triangle_a)][0];
    return at.model.cell_nodes(at.x_um, group.cell_a)[idx(node)];
}

/// Calls f(cell, node, position relative to `origin`, force) for the six nodes of a pair.
template <class F> void for_nodes_of_pair(const Configuration& at, const Contacts::Group& group,
                                          const ContactPair& pair, const F& f) {
    const MeshTopology& mesh = *at.model.topology;
    const auto side = [&](int cell, int triangle, const std::array<double, 3>& magnitude,
                          double sign) {
        const std::span<const Vec3> x = at.model.cell_nodes(at.x_um, cell);
        const auto& nodes = mesh.triangles[idx(triangle)];
        for (std::size_t i = 0; i < 3; ++i)
            f(cell, x[idx(nodes[i])], Vec3((sign * magnitude[i]) * pair.normal));
    };
    side(group.cell_a, pair.triangle_a, pair.force_a_nN, 1.0);
    side(group.cell_b, pair.triangle_b, pair.force_b_nN, -1.0);
}

/// Calls f(cell, virial) for the films of a pair of cells: sum over the corners of F x^T. Their
/// forces have no sum, so it does not matter where x is counted from.
template <class F>
void for_films_of_group(const Configuration& at, const Contacts::Group& group, const F& f) {
    const MeshTopology& mesh = *at.model.topology;
    for (const bool is_a : {true, false}) {
        const int cell = is_a ? group.cell_a : group.cell_b;
        const std::span<const Vec3> x = at.model.cell_nodes(at.x_um, cell);
        for (const ContactFilm& film : at.contacts.films_of(group, is_a)) {
            const auto& nodes = mesh.triangles[idx(film.triangle)];
            const std::array<Vec3, 3> force = film_forces_nN(at, cell, film);
            Mat3 virial = Mat3::Zero();
            for (std::size_t c = 1; c < 3; ++c)
                virial += force[c] * (x[idx(nodes[c])] - x[idx(nodes[0])]).transpose();
            f(cell, virial);
        }
    }
}

/// Virials of every cell: those of its contact forces, and half of each pair's own. loop(n, f)
/// calls f(0) ... f(n - 1), in any order.
template <class Loop> std::vector<Mat3> contact_virials(const Configuration& at, const Loop& loop) {
    const std::vector<Contacts::Group>& groups = at.contacts.groups;
    std::vector<std::array<Mat3, 2>> of_group(groups.size());  // of cell_a and cell_b
    loop(static_cast<int>(groups.size()), [&](int g) {
        const Contacts::Group& group = groups[idx(g)];
        Mat3 of_a = Mat3::Zero(), of_b = Mat3::Zero(), shared = Mat3::Zero();
        for (const ContactPair& pair : at.contacts.pairs_of(group)) {
            const Vec3& origin = origin_of_pair(at, group, pair);
            for_nodes_of_pair(at, group, pair, [&](int cell, const Vec3& x, const Vec3& F) {
                (cell == group.cell_a ? of_a : of_b) +=
                    F * (x - at.geometry.centre_um[idx(cell)]).transpose();
                shared -= F * (x - origin).transpose();
            });
        }
        for_films_of_group(at, group, [&](int cell, const Mat3& film) {
            (cell == group.cell_a ? of_a : of_b) += film;
            shared -= film;
        });
        of_group[idx(g)] = {of_a + 0.5 * shared, of_b + 0.5 * shared};
    });
    std::vector<Mat3> virial(at.model.radius_um.size(), Mat3::Zero());
    for (std::size_t g = 0; g < groups.size(); ++g) {
        virial[idx(groups[g].cell_a)] += of_group[g][0];
        virial[idx(groups[g].cell_b)] += of_group[g][1];
    }
    return virial;
}

std::vector<Mat3> stress_from(const Configuration& at, std::vector<Mat3> virial) {
    for (std::size_t cell = 0; cell < virial.size(); ++cell) {
        const Mat3 symmetric = 0.5 * (virial[cell] + virial[cell].transpose());
        virial[cell] = symmetric / at.geometry.volume_um3[cell];
    }
    return virial;
}

}  // namespace

std::vector<Mat3> cell_stress_tensors(const Configuration& at) {
    return stress_from(at, contact_virials(at, [](int n, const auto& f) {
                           for (int g = 0; g < n; ++g) f(g);
                       }));
}

std::vector<Mat3> cell_stress_tensors(const Configuration& at, Workers& workers) {
    return stress_from(at, contact_virials(at, [&](int n, const auto& f) { workers.loop(n, f); }));
}

std::vector<double> hydrostatic_stress_from_inside(const Configuration& at,
                                                   std::span<const Mat3> cell_stress_kPa,
                                                   std::span<const Vec3> force_nN) {
    std::vector<double> inside_kPa(cell_stress_kPa.size());
    for (int cell = 0; cell < at.model.n_cells(); ++cell) {
        const std::span<const Vec3> F = at.model.cell_nodes(force_nN, cell);
        const std::span<const Vec3> x = at.model.cell_nodes(at.x_um, cell);
        double unbalanced_fJ = 0.0;
        for (std::size_t i = 0; i < F.size(); ++i)
            unbalanced_fJ += F[i].dot(x[i] - at.geometry.centre_um[idx(cell)]);
        inside_kPa[idx(cell)] = cell_stress_kPa[idx(cell)].trace() / 3.0 -
                                unbalanced_fJ / (3.0 * at.geometry.volume_um3[idx(cell)]);
    }
    return inside_kPa;
}

}  // namespace spheroscope
