#include "engine/contact/contact_timing.hpp"

#include "engine/base/index.hpp"
#include "engine/base/workers.hpp"
#include "engine/contact/contact_search.hpp"
#include "engine/contact/node_box.hpp"
#include "engine/contact/simd_target.hpp"
#include "engine/contact/triangle_pair.hpp"

#include <algorithm>
#include <ctime>
#include <limits>

namespace spheroscope {
namespace {

/// Skin of the lists that the plain kernel works through, um: what a search that keeps them needs.
constexpr double k_skin_um = 0.3;

double cpu_time_s() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct Candidate {
    int cell_a, triangle_a, cell_b, triangle_b;
};

class PlainSearch {
  public:
    PlainSearch(const Model& model, std::span<const Vec3> x_um, const Geometry& geometry,
                const ContactLaw& law)
        : model_(model), x_um_(x_um), geometry_(geometry), law_(law),
          reach_um_(contact_reach_um(law)) {
        const int n = model.topology->n_triangles();
        std::vector<NodeBox> boxes;
        for (int cell = 0; cell < model.n_cells(); ++cell)
            boxes.emplace_back(model.cell_nodes(x_um, cell));
        for (int a = 0; a < model.n_cells(); ++a)
            for (int b = a + 1; b < model.n_cells(); ++b) {
                if (!boxes[idx(a)].is_near(boxes[idx(b)], reach_um_ + k_skin_um)) continue;
                for (int s = 0; s < n; ++s)
                    for (int t = 0; t < n; ++t)
                        if (are_close({a, s, b, t}, reach_um_ + k_skin_um))
                            candidates_.push_back({a, s, b, t});
            }
    }

    [[nodiscard]] std::size_t n_candidates() const { return candidates_.size(); }

    /// Number of active pairs.
    std::size_t find(std::vector<ContactPair>& pairs) const {
        pairs.clear();
        TriangleGeometry a, b;
        ContactPair pair;
        const Candidate* loaded = nullptr;
        for (const Candidate& c : candidates_) {
            if (normal(c.cell_a, c.triangle_a).dot(normal(c.cell_b, c.triangle_b)) >=
                law_.reject_cos)
                continue;
            if (!are_close(c, reach_um_)) continue;
            if (loaded == nullptr || loaded->cell_a != c.cell_a ||
                loaded->triangle_a != c.triangle_a)
                a = triangle(c.cell_a, c.triangle_a);
            loaded = &c;
            b = triangle(c.cell_b, c.triangle_b);
            if (contact_of_triangles(a, b, law_, pair) != PairOutcome::active) continue;
            pair.triangle_a = c.triangle_a;
            pair.triangle_b = c.triangle_b;
            pairs.push_back(pair);
        }
        return pairs.size();
    }

  private:
    [[nodiscard]] std::size_t at(int cell, int triangle) const {
        return idx(cell) * model_.topology->triangles.size() + idx(triangle);
    }
    [[nodiscard]] const Vec3& normal(int cell, int triangle) const {
        return geometry_.normal[at(cell, triangle)];
    }
    [[nodiscard]] bool are_close(const Candidate& c, double margin_um) const {
        const std::size_t a = at(c.cell_a, c.triangle_a), b = at(c.cell_b, c.triangle_b);
        const double range = geometry_.reach_um[a] + geometry_.reach_um[b] + margin_um;
        return (geometry_.centroid_um[a] - geometry_.centroid_um[b]).squaredNorm() < range * range;
    }
    [[nodiscard]] TriangleGeometry triangle(int cell, int triangle) const {
        const std::span<const Vec3> x = model_.cell_nodes(x_um_, cell);
        const auto& nodes = model_.topology->triangles[idx(triangle)];
        return {{x[idx(nodes[0])], x[idx(nodes[1])], x[idx(nodes[2])]}, normal(cell, triangle)};
    }

    const Model& model_;
    std::span<const Vec3> x_um_;
    const Geometry& geometry_;
    ContactLaw law_;
    double reach_um_;
    std::vector<Candidate> candidates_;
};

ContactTiming::Kernel per_pair(double time_s, std::size_t candidates, std::size_t active) {
    return {static_cast<std::int64_t>(candidates), static_cast<std::int64_t>(active),
            1e9 * time_s / static_cast<double>(candidates),
            1e9 * time_s / static_cast<double>(active)};
}

}  // namespace

ContactTiming time_contacts(const Model& model, std::span<const Vec3> x_um, const ContactLaw& law,
                            ContactPrecision precision, const Repetitions& repetitions) {
    Geometry geometry;
    geometry.allocate(model, Need::triangles);
    for (int cell = 0; cell < model.n_cells(); ++cell)
        geometry.compute_cell(model, x_um, Need::triangles, cell);
    const PlainSearch plain(model, x_um, geometry, law);
    ContactSearch search(law, precision);
    Workers workers(1);
    Contacts contacts;
    std::vector<ContactPair> pairs;
    // Once without a clock: a step finds its memory where the one before has left it.
    static_cast<void>(plain.find(pairs));
    search.find(model, x_um, geometry, workers, contacts);
    double plain_s = std::numeric_limits<double>::infinity(), simd_s = plain_s;
    Repetitions::Count count(repetitions);
    while (count.goes_on()) {
        const double start_s = cpu_time_s();
        static_cast<void>(plain.find(pairs));
        const double middle_s = cpu_time_s();
        search.find(model, x_um, geometry, workers, contacts);
        const double end_s = cpu_time_s();
        plain_s = std::min(plain_s, middle_s - start_s);
        simd_s = std::min(simd_s, end_s - middle_s);
    }
    const auto candidates =
        static_cast<std::size_t>(search.counts().candidates / (count.n_begun() + 1));
    return {per_pair(plain_s, plain.n_candidates(), pairs.size()),
            per_pair(simd_s, candidates, contacts.n_pairs()), simd_target()};
}

}  // namespace spheroscope
