#include "engine/contact/contact_search.hpp"

#include "engine/contact/triangle_pair.hpp"

#include <algorithm>
#include <cmath>

namespace spheroscope {
namespace {

std::size_t idx(int i) { return static_cast<std::size_t>(i); }

/// A triangle near the other cell, with its extent along the sweep axis.
struct Swept {
    double low, high;
    int triangle;
};

}  // namespace

double ContactSearch::reach_um() const {
    // At the centroid of a contact the gap along n is 2 h0 / c - delta, with c^2 = (1 - n_A.n_B) /
    // 2 and delta between 0 and the largest overlap: beyond that two surfaces are through each
    // other.
    const double widest_um = 2.0 * law_.h0_um / std::sqrt(0.5 * (1.0 - law_.reject_cos));
    return std::max(widest_um, law_.largest_overlap_um - 2.0 * law_.h0_um);
}

bool ContactSearch::lists_are_valid(const Model& model, std::span<const Vec3> x_um) const {
    if (listed_x_um_.size() != model.n_all_nodes()) return false;
    const double limit2 = 0.25 * skin_um_ * skin_um_;
    for (std::size_t i = 0; i < x_um.size(); ++i)
        if (!((x_um[i] - listed_x_um_[i]).squaredNorm() < limit2)) return false;
    return true;
}

void ContactSearch::build_lists(const Model& model, std::span<const Vec3> x_um,
                                const Geometry& geometry, Workers& workers) {
    ++counts_.list_builds;
    listed_x_um_.assign(x_um.begin(), x_um.end());
    boxes_.resize(idx(model.n_cells()));
    workers.loop(model.n_cells(), [&](int cell) {
        const std::span<const Vec3> x = model.cell_nodes(x_um, cell);
        Box box{x[0], x[0]};
        for (const Vec3& node : x) {
            box.low = box.low.cwiseMin(node);
            box.high = box.high.cwiseMax(node);
        }
        boxes_[idx(cell)] = box;
    });
    const double margin = reach_um() + skin_um_;
    n_groups_ = 0;
    for (int a = 0; a < model.n_cells(); ++a)
        for (int b = a + 1; b < model.n_cells(); ++b) {
            const Box& p = boxes_[idx(a)];
            const Box& q = boxes_[idx(b)];
            if (((p.low - q.high).array() > margin).any() ||
                ((q.low - p.high).array() > margin).any())
                continue;
            if (n_groups_ == groups_.size()) groups_.emplace_back();
            groups_[n_groups_].cell_a = a;
            groups_[n_groups_].cell_b = b;
            ++n_groups_;
        }
    workers.loop(static_cast<int>(n_groups_),
                 [&](int g) { collect_candidates(model, geometry, groups_[idx(g)]); });
}

void ContactSearch::collect_candidates(const Model& model, const Geometry& geometry,
                                       CandidateGroup& group) const {
    group.candidates.clear();
    const double margin = reach_um() + skin_um_;
    const Box& box_a = boxes_[idx(group.cell_a)];
    const Box& box_b = boxes_[idx(group.cell_b)];
    // The contact can only lie where the two boxes meet; sweep along the longest side of that
    // region.
    const Vec3 meet = box_a.high.cwiseMin(box_b.high) - box_a.low.cwiseMax(box_b.low);
    Eigen::Index axis = 0;
    meet.maxCoeff(&axis);

    const int n_triangles = model.topology->n_triangles();
    const auto near_box = [&](int cell, const Box& other, std::vector<Swept>& swept) {
        swept.clear();
        for (int t = 0; t < n_triangles; ++t) {
            const std::size_t g = idx(cell) * idx(n_triangles) + idx(t);
            const Vec3& c = geometry.centroid_um[g];
            const double r = geometry.reach_um[g];
            const double grown = r + margin;
            if (((other.low - c).array() > grown).any() || ((c - other.high).array() > grown).any())
                continue;
            swept.push_back({c[axis] - r, c[axis] + r, t});
        }
        std::sort(swept.begin(), swept.end(), [](const Swept& p, const Swept& q) {
            return p.low != q.low ? p.low < q.low : p.triangle < q.triangle;
        });
    };
    thread_local std::vector<Swept> of_a, of_b;
    near_box(group.cell_a, box_b, of_a);
    near_box(group.cell_b, box_a, of_b);

    double widest_b = 0.0;
    for (const Swept& b : of_b) widest_b = std::max(widest_b, b.high - b.low);
    auto first_b = of_b.begin();
    for (const Swept& a : of_a) {
        while (first_b != of_b.end() && first_b->low < a.low - margin - widest_b) ++first_b;
        const std::size_t ga = idx(group.cell_a) * idx(n_triangles) + idx(a.triangle);
        for (auto b = first_b; b != of_b.end() && b->low <= a.high + margin; ++b) {
            if (b->high < a.low - margin) continue;
            const std::size_t gb = idx(group.cell_b) * idx(n_triangles) + idx(b->triangle);
            const double range = geometry.reach_um[ga] + geometry.reach_um[gb] + margin;
            if ((geometry.centroid_um[ga] - geometry.centroid_um[gb]).squaredNorm() >=
                range * range)
                continue;
            group.candidates.push_back({a.triangle, b->triangle});
        }
    }
    std::sort(group.candidates.begin(), group.candidates.end(),
              [](const Candidate& p, const Candidate& q) {
                  return p.triangle_a != q.triangle_a ? p.triangle_a < q.triangle_a
                                                      : p.triangle_b < q.triangle_b;
              });
}

void ContactSearch::evaluate(const Model& model, std::span<const Vec3> x_um,
                             const Geometry& geometry, CandidateGroup& group) const {
    group.active.clear();
    group.too_deep = 0;
    const MeshTopology& mesh = *model.topology;
    const std::size_t first_a = idx(group.cell_a) * mesh.triangles.size();
    const std::size_t first_b = idx(group.cell_b) * mesh.triangles.size();
    const std::span<const Vec3> xa = model.cell_nodes(x_um, group.cell_a);
    const std::span<const Vec3> xb = model.cell_nodes(x_um, group.cell_b);
    const double reach = reach_um();
    TriangleGeometry a, b;
    int loaded_a = -1;
    ContactPair pair;
    for (const Candidate& candidate : group.candidates) {
        const std::size_t ga = first_a + idx(candidate.triangle_a);
        const std::size_t gb = first_b + idx(candidate.triangle_b);
        if (geometry.normal[ga].dot(geometry.normal[gb]) >= law_.reject_cos) continue;
        const Vec3 between = geometry.centroid_um[ga] - geometry.centroid_um[gb];
        const double range = geometry.reach_um[ga] + geometry.reach_um[gb] + reach;
        if (between.squaredNorm() >= range * range) continue;
        if (loaded_a != candidate.triangle_a) {
            const auto& nodes = mesh.triangles[idx(candidate.triangle_a)];
            a = {{xa[idx(nodes[0])], xa[idx(nodes[1])], xa[idx(nodes[2])]}, geometry.normal[ga]};
            loaded_a = candidate.triangle_a;
        }
        const auto& nodes = mesh.triangles[idx(candidate.triangle_b)];
        b = {{xb[idx(nodes[0])], xb[idx(nodes[1])], xb[idx(nodes[2])]}, geometry.normal[gb]};
        switch (contact_of_triangles(a, b, law_, pair)) {
        case PairOutcome::apart: break;
        case PairOutcome::too_deep: ++group.too_deep; break;
        case PairOutcome::active:
            pair.triangle_a = candidate.triangle_a;
            pair.triangle_b = candidate.triangle_b;
            group.active.push_back(pair);
            break;
        }
    }
}

void ContactSearch::find(const Model& model, std::span<const Vec3> x_um, const Geometry& geometry,
                         Workers& workers, Contacts& contacts) {
    if (!lists_are_valid(model, x_um)) build_lists(model, x_um, geometry, workers);
    workers.loop(static_cast<int>(n_groups_),
                 [&](int g) { evaluate(model, x_um, geometry, groups_[idx(g)]); });

    contacts.clear(model.n_cells());
    thread_local std::vector<int> source;  // of each kept group
    source.clear();
    std::int64_t n_pairs = 0;
    for (std::size_t g = 0; g < n_groups_; ++g) {
        const CandidateGroup& group = groups_[g];
        counts_.candidates += static_cast<std::int64_t>(group.candidates.size());
        counts_.too_deep += group.too_deep;
        if (group.active.empty()) continue;
        contacts.groups.push_back({group.cell_a, group.cell_b, {}});
        source.push_back(static_cast<int>(g));
        n_pairs += static_cast<std::int64_t>(group.active.size());
    }
    counts_.active_pairs += n_pairs;
    const std::vector<int>& from = source;
    workers.loop(static_cast<int>(contacts.groups.size()),
                 [&](int g) { contacts.groups[idx(g)].pairs = groups_[idx(from[idx(g)])].active; });
    contacts.index_sides(model.n_cells());
}

}  // namespace spheroscope
