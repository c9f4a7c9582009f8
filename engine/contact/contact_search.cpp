#include "engine/contact/contact_search.hpp"

#include "engine/base/index.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace spheroscope {

double contact_reach_um(const ContactLaw& law) {
    // At the centroid of a contact the gap along n is 2 h0 / c - delta, with c^2 = (1 - n_A.n_B) /
    // 2 and delta between 0 and the largest overlap: beyond that two surfaces are through each
    // other.
    const double widest_um = 2.0 * law.h0_um / std::sqrt(0.5 * (1.0 - law.reject_cos));
    return std::max(widest_um, law.largest_overlap_um - 2.0 * law.h0_um);
}

void ContactSearch::find_cell_pairs(const Model& model, std::span<const Vec3> x_um,
                                    Workers& workers) {
    boxes_.resize(idx(model.n_cells()));
    workers.loop(model.n_cells(),
                 [&](int cell) { boxes_[idx(cell)] = NodeBox(model.cell_nodes(x_um, cell)); });
    const double margin = contact_reach_um(law_);
    cell_pairs_.clear();
    for (int a = 0; a < model.n_cells(); ++a)
        for (int b = a + 1; b < model.n_cells(); ++b)
            if (boxes_[idx(a)].is_near(boxes_[idx(b)], margin)) cell_pairs_.push_back({a, b, {}});
}

void ContactSearch::set_groups(Contacts& contacts) {
    old_groups_.swap(contacts.groups);
    contacts.groups.clear();
    auto old = old_groups_.begin();
    for (const CellPair& cells : cell_pairs_) {
        Contacts::Group& group = contacts.groups.emplace_back();
        group.cell_a = cells.cell_a;
        group.cell_b = cells.cell_b;
        const auto is_before = [&](const Contacts::Group& g) {
            return std::pair(g.cell_a, g.cell_b) < std::pair(cells.cell_a, cells.cell_b);
        };
        while (old != old_groups_.end() && is_before(*old)) ++old;
        if (old != old_groups_.end() && old->cell_a == cells.cell_a && old->cell_b == cells.cell_b)
            group.pairs.swap(old->pairs);
        group.pairs.clear();
    }
    old_groups_.clear();
}

template <class T> void ContactSearch::fill_groups(const Model& model, std::span<const Vec3> x_um,
                                                   const Geometry& geometry, Workers& workers,
                                                   PackedTriangles<T>& triangles,
                                                   Contacts& contacts) {
    triangles.allocate(model);
    workers.loop(model.n_cells(), [&](int cell) {
        const NodeBox& box = boxes_[idx(cell)];
        triangles.pack_cell(model, x_um, geometry, cell, 0.5 * (box.low + box.high));
    });
    const double reach_um = contact_reach_um(law_);
    workers.loop(static_cast<int>(cell_pairs_.size()), [&](int g) {
        thread_local KernelWorkspace<T> workspace;
        CellPair& cells = cell_pairs_[idx(g)];
        cells.counts = find_pairs_of_cells(triangles, boxes_, cells.cell_a, cells.cell_b, law_,
                                           reach_um, workspace, contacts.groups[idx(g)].pairs);
    });
}

void ContactSearch::find(const Model& model, std::span<const Vec3> x_um, const Geometry& geometry,
                         Workers& workers, Contacts& contacts) {
    find_cell_pairs(model, x_um, workers);
    set_groups(contacts);
    if (precision_ == ContactPrecision::single_precision)
        fill_groups(model, x_um, geometry, workers, single_, contacts);
    else
        fill_groups(model, x_um, geometry, workers, double_, contacts);
    for (const CellPair& cells : cell_pairs_) {
        counts_.candidates += cells.counts.candidates;
        counts_.too_deep += cells.counts.too_deep;
    }
    std::erase_if(contacts.groups, [](const Contacts::Group& g) { return g.pairs.empty(); });
    counts_.active_pairs += static_cast<std::int64_t>(contacts.n_pairs());
    contacts.index_sides(model.n_cells());
}

}  // namespace spheroscope
