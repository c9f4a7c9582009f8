#include "engine/run/snapshot_maker.hpp"

#include "engine/measures/pair_forces.hpp"

#include <utility>

namespace spheroscope {
namespace {

void append(std::vector<float>& values, const Vec3& v) {
    for (const double component : {v.x(), v.y(), v.z()})
        values.push_back(static_cast<float>(component));
}

std::size_t size_of(const Field& field, const Model& model) {
    switch (field.place) {
    case Place::node: return model.n_all_nodes();
    case Place::triangle: return model.n_all_triangles();
    case Place::cell: return model.radius_um.size();
    }
    return 0;
}

/// The part of an array of `values` that belongs to one cell.
template <class T> std::span<const T> part_of(const std::vector<T>& values, int cell, int n_parts) {
    const auto n = static_cast<std::size_t>(n_parts);
    return std::span(values).subspan(static_cast<std::size_t>(cell) * n, n);
}

std::vector<Vec3> vectors_of(std::span<const float> components) {
    std::vector<Vec3> vectors;
    for (std::size_t i = 0; i + 2 < components.size(); i += 3)
        vectors.emplace_back(double{components[i]}, double{components[i + 1]},
                             double{components[i + 2]});
    return vectors;
}

/// Outward unit normals at the nodes of one closed surface.
std::vector<Vec3> node_normals(const MeshTopology& mesh, const std::vector<Vec3>& x) {
    std::vector<Vec3> normals(x.size(), Vec3::Zero());
    for (const auto& nodes : mesh.triangles) {
        const auto at = [&](std::size_t k) { return static_cast<std::size_t>(nodes[k]); };
        const Vec3 normal = (x[at(1)] - x[at(0)]).cross(x[at(2)] - x[at(0)]);
        for (std::size_t k = 0; k < 3; ++k) normals[at(k)] += normal;
    }
    for (Vec3& normal : normals) normal.normalize();
    return normals;
}

}  // namespace

void prolong(Snapshot& snapshot, const Prolongation& prolongation) {
    const MeshTopology& coarse = prolongation.coarse();
    const MeshTopology& fine = prolongation.fine();
    const int n_cells = snapshot.header->n_cells;
    std::vector<float> x_um, normal;
    for (int cell = 0; cell < n_cells; ++cell) {
        const std::vector<Vec3> x =
            prolongation.positions(vectors_of(part_of(snapshot.x_um, cell, 3 * coarse.n_nodes())));
        for (const Vec3& node : x) append(x_um, node);
        for (const Vec3& n : node_normals(fine, x)) append(normal, n);
    }
    snapshot.x_um = std::move(x_um);
    snapshot.normal = std::move(normal);
    for (std::size_t f = 0; f < snapshot.fields.size(); ++f) {
        std::vector<float> values;
        for (int cell = 0; cell < n_cells; ++cell) switch (snapshot.header->fields[f]->place) {
            case Place::cell:
                values.push_back(snapshot.fields[f][static_cast<std::size_t>(cell)]);
                break;
            case Place::node: {
                const std::vector<float> at_nodes = prolongation.node_values<float>(
                    part_of(snapshot.fields[f], cell, coarse.n_nodes()));
                values.insert(values.end(), at_nodes.begin(), at_nodes.end());
                break;
            }
            case Place::triangle: {
                const std::span<const float> of_cell =
                    part_of(snapshot.fields[f], cell, coarse.n_triangles());
                for (int t = 0; t < fine.n_triangles(); ++t)
                    values.push_back(of_cell[static_cast<std::size_t>(prolongation.parent(t))]);
                break;
            }
            }
        snapshot.fields[f] = std::move(values);
    }
}

Snapshot make_snapshot(std::shared_ptr<const RunHeader> header, const MeasureInput& input,
                       const Diagnostics& diagnostics, const Totals& totals, Work& work,
                       Workers& workers) {
    const Configuration& at = input.at;
    Snapshot snapshot;
    snapshot.x_um.reserve(3 * at.x_um.size());
    snapshot.normal.reserve(3 * at.x_um.size());
    for (const Vec3& x : at.x_um) append(snapshot.x_um, x);
    for (const Vec3& gradient : at.geometry.volume_gradient_um2)
        append(snapshot.normal, gradient.normalized());
    std::vector<PairForce> pairs;
    const int n_fields = static_cast<int>(header->fields.size());
    for (const Field* field : header->fields) {
        snapshot.fields.emplace_back(size_of(*field, at.model));
        for (Work::TermCount& count : work.fields)
            if (count.term == field->name) ++count.evaluations;
    }
    workers.loop(n_fields + 1, [&](int k) {
        const auto f = static_cast<std::size_t>(k);
        if (k < n_fields)
            header->fields[f]->compute(input, snapshot.fields[f]);
        else
            pairs = pair_forces(at);
    });
    for (const Vec3& centre : at.geometry.centre_um) append(snapshot.centre_um, centre);
    for (const double volume : at.geometry.volume_um3)
        snapshot.volume_um3.push_back(static_cast<float>(volume));
    snapshot.pressure_kPa.assign(at.model.radius_um.size(), 0.0F);
    for (std::size_t cell = 0; cell < input.pressure_kPa.size(); ++cell)
        snapshot.pressure_kPa[cell] = static_cast<float>(input.pressure_kPa[cell]);
    for (const PairForce& pair : pairs)
        if (pair.area_um2 > input.touching_area_um2)
            snapshot.links.push_back({pair.cell_a, pair.cell_b, static_cast<float>(pair.force_nN),
                                      static_cast<float>(pair.area_um2)});
    snapshot.header = std::move(header);
    snapshot.totals = totals;
    snapshot.diagnostics = diagnostics;
    return snapshot;
}

}  // namespace spheroscope
