#include "tests/reference/all_pairs.hpp"

#include "engine/contact/triangle_pair.hpp"

namespace spheroscope::reference {
namespace {

TriangleGeometry triangle_of(const Model& model, std::span<const Vec3> x_um,
                             const Geometry& geometry, int cell, int triangle) {
    const auto t = static_cast<std::size_t>(triangle);
    const auto& nodes = model.topology->triangles[t];
    const std::span<const Vec3> x = model.cell_nodes(x_um, cell);
    const auto at = [&](std::size_t i) { return x[static_cast<std::size_t>(nodes[i])]; };
    return {{at(0), at(1), at(2)},
            model.cell_triangles(std::span<const Vec3>(geometry.normal), cell)[t]};
}

}  // namespace

Contacts contacts_of_all_pairs(const Model& model, std::span<const Vec3> x_um,
                               const Geometry& geometry, const ContactLaw& law) {
    Contacts contacts;
    contacts.clear(model.n_cells());
    const int n_triangles = model.topology->n_triangles();
    for (int a = 0; a < model.n_cells(); ++a)
        for (int b = a + 1; b < model.n_cells(); ++b) {
            Contacts::Group group{a, b, {}};
            for (int s = 0; s < n_triangles; ++s) {
                const TriangleGeometry of_a = triangle_of(model, x_um, geometry, a, s);
                for (int t = 0; t < n_triangles; ++t) {
                    ContactPair pair;
                    if (contact_of_triangles(of_a, triangle_of(model, x_um, geometry, b, t), law,
                                             pair) != PairOutcome::active)
                        continue;
                    pair.triangle_a = s;
                    pair.triangle_b = t;
                    group.pairs.push_back(pair);
                }
            }
            if (!group.pairs.empty()) contacts.groups.push_back(std::move(group));
        }
    contacts.index_sides(model.n_cells());
    return contacts;
}

}  // namespace spheroscope::reference
