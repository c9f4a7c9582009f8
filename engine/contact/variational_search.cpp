// Lists and bookkeeping of the law `variational`; the law itself is in variational_contact.cpp.
#include "engine/contact/variational_search.hpp"

#include "engine/base/index.hpp"
#include "engine/contact/closest_point.hpp"
#include "engine/contact/node_box.hpp"

#include <algorithm>
#include <cmath>

namespace spheroscope {
namespace {

/// A triangle of the other cell, sorted by its centre along one axis.
struct Swept {
    double along;
    int triangle;
};

double distance_um(const Vec3& p, std::span<const Vec3> nodes,
                   const MeshTopology::Triangle& corners) {
    const Vec3 &a = nodes[idx(corners[0])], &b = nodes[idx(corners[1])],
               &c = nodes[idx(corners[2])];
    const auto weight = closest_barycentric(p, a, b, c);
    return (p - (weight[0] * a + weight[1] * b + weight[2] * c)).norm();
}

}  // namespace

bool VariationalSearch::lists_are_valid(const Model& model, std::span<const Vec3> x_um) const {
    if (listed_x_um_.size() != model.n_all_nodes()) return false;
    const double limit2 = 0.25 * skin_um_ * skin_um_;
    for (std::size_t i = 0; i < x_um.size(); ++i)
        if (!((x_um[i] - listed_x_um_[i]).squaredNorm() < limit2)) return false;
    return true;
}

double VariationalSearch::listed_distance_um(const View& view) const {
    // A part needs the overlaps of all its corners as soon as one of them touches. That one is no
    // farther than `range`, the others no farther than a side of the part more; sides grow by less
    // than the skin before the next rebuild, and so do distances, there and back.
    const double range_um = std::max(2.0 * law_.h0_um, law_.largest_overlap_um - 2.0 * law_.h0_um);
    const auto reach =
        view.model.cell_triangles(std::span<const double>(view.geometry.reach_um), view.own);
    const double longest_side_um =
        2.0 * *std::max_element(reach.begin(), reach.end()) / samples_.parts_per_edge;
    return range_um + longest_side_um + 2.0 * skin_um_;
}

void VariationalSearch::build_lists(const Model& model, std::span<const Vec3> x_um,
                                    const Geometry& geometry, Workers& workers) {
    if (samples_.samples.empty())
        samples_ = make_surface_samples(*model.topology, samples_per_edge(model, law_.h0_um));
    ++list_builds_;
    listed_x_um_.assign(x_um.begin(), x_um.end());
    thread_local std::vector<NodeBox> boxes;
    thread_local std::vector<double> margin_um;
    boxes.clear();
    margin_um.clear();
    for (int cell = 0; cell < model.n_cells(); ++cell) {
        boxes.emplace_back(model.cell_nodes(x_um, cell));
        margin_um.push_back(listed_distance_um({model, geometry, {}, {}, cell, cell}));
    }
    n_groups_ = 0;
    for (int a = 0; a < model.n_cells(); ++a)
        for (int b = a + 1; b < model.n_cells(); ++b) {
            const double margin = std::max(margin_um[idx(a)], margin_um[idx(b)]);
            if (!boxes[idx(a)].is_near(boxes[idx(b)], margin)) continue;
            if (n_groups_ == groups_.size()) groups_.emplace_back();
            groups_[n_groups_].found.cell_a = a;
            groups_[n_groups_].found.cell_b = b;
            ++n_groups_;
        }
    workers.loop(static_cast<int>(n_groups_), [&](int g) {
        Group& group = groups_[idx(g)];
        const auto a = model.cell_nodes(x_um, group.found.cell_a);
        const auto b = model.cell_nodes(x_um, group.found.cell_b);
        list_side({model, geometry, a, b, group.found.cell_a, group.found.cell_b}, group.of_a);
        list_side({model, geometry, b, a, group.found.cell_b, group.found.cell_a}, group.of_b);
    });
}

void VariationalSearch::list_side(const View& view, Side& side) const {
    side.samples.clear();
    side.first.assign(1, 0);
    side.candidates.clear();
    side.triangles.clear();
    const MeshTopology& mesh = *view.model.topology;
    const double limit_um = listed_distance_um(view);
    const NodeBox own_box(view.own_um), other_box(view.other_um);
    const auto centre =
        view.model.cell_triangles(std::span<const Vec3>(view.geometry.centroid_um), view.other);
    const auto reach =
        view.model.cell_triangles(std::span<const double>(view.geometry.reach_um), view.other);

    // The other cell's triangles near this one, along the longest side of where the boxes meet.
    Eigen::Index axis = 0;
    (own_box.high.cwiseMin(other_box.high) - own_box.low.cwiseMax(other_box.low)).maxCoeff(&axis);
    thread_local std::vector<Swept> swept;
    swept.clear();
    double widest_um = 0.0;
    for (std::size_t t = 0; t < centre.size(); ++t) {
        if (!own_box.is_within(centre[t], limit_um + reach[t] + 2.0 * skin_um_)) continue;
        swept.push_back({centre[t][axis], static_cast<int>(t)});
        widest_um = std::max(widest_um, reach[t]);
    }
    std::sort(swept.begin(), swept.end(), [](const Swept& p, const Swept& q) {
        return p.along != q.along ? p.along < q.along : p.triangle < q.triangle;
    });

    thread_local std::vector<char> is_listed;
    is_listed.assign(samples_.samples.size(), 0);
    thread_local std::vector<std::pair<double, int>> near;  // distance, triangle
    for (std::size_t s = 0; s < samples_.samples.size(); ++s) {
        const auto& [nodes, weight] = samples_.samples[s];
        const Vec3 p = weight[0] * view.own_um[idx(nodes[0])] +
                       weight[1] * view.own_um[idx(nodes[1])] +
                       weight[2] * view.own_um[idx(nodes[2])];
        if (!other_box.is_within(p, limit_um)) continue;
        near.clear();
        double nearest_um = limit_um;
        const double from = p[axis] - limit_um - 2.0 * skin_um_ - widest_um;
        const double to = p[axis] + limit_um + 2.0 * skin_um_ + widest_um;
        auto t = std::lower_bound(swept.begin(), swept.end(), from,
                                  [](const Swept& q, double low) { return q.along < low; });
        for (; t != swept.end() && t->along <= to; ++t) {
            const double range = nearest_um + 2.0 * skin_um_ + reach[idx(t->triangle)];
            if ((p - centre[idx(t->triangle)]).squaredNorm() > range * range) continue;
            const double d = distance_um(p, view.other_um, mesh.triangles[idx(t->triangle)]);
            near.emplace_back(d, t->triangle);
            nearest_um = std::min(nearest_um, d);
        }
        if (near.empty() || nearest_um >= limit_um) continue;
        // Distances change by less than the skin before the next rebuild: the nearest one then is
        // among those that are now within twice the skin of the nearest.
        const auto begin = static_cast<std::ptrdiff_t>(side.candidates.size());
        for (const auto& [d, triangle] : near)
            if (d <= nearest_um + 2.0 * skin_um_) side.candidates.push_back(triangle);
        std::sort(side.candidates.begin() + begin, side.candidates.end());
        side.samples.push_back(static_cast<int>(s));
        side.first.push_back(static_cast<int>(side.candidates.size()));
        is_listed[s] = 1;
    }
    for (int triangle = 0; triangle < mesh.n_triangles(); ++triangle) {
        const auto of = samples_.samples_of(triangle);
        if (std::any_of(of.begin(), of.end(), [&](int s) { return is_listed[idx(s)] != 0; }))
            side.triangles.push_back(triangle);
    }
}

void VariationalSearch::find(const Model& model, std::span<const Vec3> x_um,
                             const Geometry& geometry, Workers& workers, Contacts& contacts) {
    if (!lists_are_valid(model, x_um)) build_lists(model, x_um, geometry, workers);
    workers.loop(static_cast<int>(n_groups_), [&](int g) {
        Group& group = groups_[idx(g)];
        Contacts::Group& found = group.found;
        found.pairs.clear();
        found.films_a.clear();
        found.films_b.clear();
        group.candidates = group.too_deep = 0;
        const auto a = model.cell_nodes(x_um, found.cell_a);
        const auto b = model.cell_nodes(x_um, found.cell_b);
        evaluate({model, geometry, a, b, found.cell_a, found.cell_b}, group.of_a, true, group);
        evaluate({model, geometry, b, a, found.cell_b, found.cell_a}, group.of_b, false, group);
    });

    contacts.clear(model.n_cells());
    for (std::size_t g = 0; g < n_groups_; ++g) {
        const Group& group = groups_[g];
        counts_.candidates += group.candidates;
        counts_.too_deep += group.too_deep;
        if (!group.found.pairs.empty()) contacts.groups.push_back(group.found);
    }
    counts_.active_pairs += static_cast<std::int64_t>(contacts.n_pairs());
    contacts.index_sides(model.n_cells());
}

}  // namespace spheroscope
