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

}  // namespace

Snapshot make_snapshot(std::shared_ptr<const RunHeader> header, const MeasureInput& input,
                       const Diagnostics& diagnostics, const Totals& totals, Work& work) {
    const Configuration& at = input.at;
    Snapshot snapshot;
    snapshot.x_um.reserve(3 * at.x_um.size());
    snapshot.normal.reserve(3 * at.x_um.size());
    for (const Vec3& x : at.x_um) append(snapshot.x_um, x);
    for (const Vec3& gradient : at.geometry.volume_gradient_um2)
        append(snapshot.normal, gradient.normalized());
    for (const Field* field : header->fields) {
        std::vector<float>& values = snapshot.fields.emplace_back(size_of(*field, at.model));
        field->compute(input, values);
        for (Work::TermCount& count : work.fields)
            if (count.term == field->name) ++count.evaluations;
    }
    for (const Vec3& centre : at.geometry.centre_um) append(snapshot.centre_um, centre);
    for (const double volume : at.geometry.volume_um3)
        snapshot.volume_um3.push_back(static_cast<float>(volume));
    snapshot.pressure_kPa.assign(at.model.radius_um.size(), 0.0F);
    for (std::size_t cell = 0; cell < input.pressure_kPa.size(); ++cell)
        snapshot.pressure_kPa[cell] = static_cast<float>(input.pressure_kPa[cell]);
    for (const PairForce& pair : pair_forces(at))
        if (pair.area_um2 > input.touching_area_um2)
            snapshot.links.push_back({pair.cell_a, pair.cell_b, static_cast<float>(pair.force_nN),
                                      static_cast<float>(pair.area_um2)});
    snapshot.header = std::move(header);
    snapshot.totals = totals;
    snapshot.diagnostics = diagnostics;
    return snapshot;
}

}  // namespace spheroscope
