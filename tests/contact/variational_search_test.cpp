#include "engine/contact/variational_search.hpp"
#include "tests/reference/made_up_cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace spheroscope::test {
namespace {

constexpr double k_skin_um = 0.3;
const ContactLaw k_law = [] {
    ContactLaw law = adhesive_law(0.5, 0.3, 2.0, 0.0);
    law.form = ContactForm::variational;
    return law;
}();

Contacts found(VariationalSearch& search, const Cluster& cells, Workers& workers) {
    Contacts contacts;
    search.find(cells.model, cells.x_um,
                geometry_of(cells.model, cells.x_um, Need::triangles | Need::volumes), workers,
                contacts);
    return contacts;
}

/// Everything that two searches found, as numbers (without the padding of the structs).
std::vector<double> numbers_of(const Contacts& contacts) {
    std::vector<double> numbers;
    const auto add = [&](auto... values) { (numbers.push_back(double(values)), ...); };
    for (const Contacts::Group& group : contacts.groups) {
        add(group.cell_a, group.cell_b, group.pairs.size());
        for (const ContactPair& pair : group.pairs) {
            add(pair.triangle_a, pair.triangle_b, pair.overlap_um, pair.largest_overlap_um,
                pair.normal.x(), pair.normal.y(), pair.normal.z(), pair.area_um2);
            for (const auto* three : {&pair.lambda, &pair.mu, &pair.force_a_nN, &pair.force_b_nN})
                numbers.insert(numbers.end(), three->begin(), three->end());
        }
        for (const bool is_a : {true, false})
            for (const ContactFilm& film : contacts.films_of(group, is_a))
                add(film.triangle, film.tension_nN_per_um, film.energy_fJ);
    }
    return numbers;
}

double largest_overlap_um(const Contacts& contacts) {
    double largest_um = -std::numeric_limits<double>::infinity();
    for (const Contacts::Group& group : contacts.groups)
        for (const ContactPair& pair : group.pairs)
            largest_um = std::max(largest_um, double{pair.largest_overlap_um});
    return largest_um;
}

TEST(SurfaceSamples, OfNeighbouringTrianglesAreSharedAndPartsTileATriangle) {
    const auto mesh = make_icosphere(42);
    for (const int m : {1, 2, 3, 5}) {
        const SurfaceSamples s = make_surface_samples(*mesh, m);
        const int n = mesh->n_nodes(), e = mesh->n_edges(), t = mesh->n_triangles();
        EXPECT_EQ(static_cast<int>(s.samples.size()), n + e * (m - 1) + t * (m - 1) * (m - 2) / 2);
        ASSERT_EQ(static_cast<int>(s.parts.size()), m * m);
        for (const auto& part : s.parts) {
            const auto& p = s.local_weights[static_cast<std::size_t>(part[0])];
            const auto& q = s.local_weights[static_cast<std::size_t>(part[1])];
            const auto& r = s.local_weights[static_cast<std::size_t>(part[2])];
            const double area = (q[1] - p[1]) * (r[2] - p[2]) - (r[1] - p[1]) * (q[2] - p[2]);
            EXPECT_NEAR(area, 1.0 / (m * m), 1e-14);  // of one orientation
        }
        for (int triangle = 0; triangle < t; ++triangle)
            for (std::size_t k = 0; k < s.local_weights.size(); ++k) {
                const auto& [nodes, weight] =
                    s.samples[static_cast<std::size_t>(s.samples_of(triangle)[k])];
                const auto place = [&](const auto& corner, const auto& w) {
                    Vec3 x = Vec3::Zero();
                    for (std::size_t c = 0; c < 3; ++c)
                        x += w[c] * mesh->unit_shape[static_cast<std::size_t>(corner[c])];
                    return x;
                };
                const auto& corners = mesh->triangles[static_cast<std::size_t>(triangle)];
                EXPECT_LT((place(nodes, weight) - place(corners, s.local_weights[k])).norm(),
                          1e-14);
            }
    }
}

TEST(SurfaceSamples, AreNoFartherApartThanTheRangeOfAdhesion) {
    const auto at = [](int n_nodes) {
        return samples_per_edge(make_model(make_icosphere(n_nodes), {9.0}), 0.3);
    };
    EXPECT_EQ(at(162), 5);
    EXPECT_EQ(at(642), 3);
    EXPECT_EQ(at(2562), 2);
}

TEST(VariationalSearch, DoesNotDependOnTheAgeOfItsLists) {
    Cluster cells = make_cluster(162, 3, 0.4, 0.03);
    Workers workers(1);
    VariationalSearch old(k_law, k_skin_um);
    found(old, cells, workers);
    for (std::size_t i = 0; i < cells.x_um.size(); ++i)
        cells.x_um[i] += 0.08 * Vec3(std::sin(double(i)), std::cos(2.0 * double(i)),
                                     std::sin(3.0 * double(i) + 1.0));
    VariationalSearch fresh(k_law, k_skin_um);
    const Contacts from_old = found(old, cells, workers), from_new = found(fresh, cells, workers);
    EXPECT_EQ(old.list_builds(), 1) << "the lists must be old ones";
    EXPECT_GT(from_new.n_pairs(), 100U);
    EXPECT_EQ(numbers_of(from_old), numbers_of(from_new));
}

TEST(VariationalSearch, GivesTheSameBitsOnAnyNumberOfThreads) {
    const Cluster cells = make_cluster(162, 3, 0.4, 0.03);
    Workers one(1);
    VariationalSearch alone(k_law, k_skin_um);
    const Contacts expected = found(alone, cells, one);
    EXPECT_EQ(expected.groups.size(), 6U);
    for (const int n_threads : {2, 3, 16}) {
        Workers workers(n_threads);
        VariationalSearch search(k_law, k_skin_um);
        EXPECT_EQ(numbers_of(found(search, cells, workers)), numbers_of(expected)) << n_threads;
    }
}

TEST(VariationalSearch, LeavesOutAndCountsSamplesThatAreTooDeep) {
    Workers workers(1);
    VariationalSearch shallow(k_law, k_skin_um), deep(k_law, k_skin_um);
    const Contacts at_rest = found(shallow, make_doublet(162, 3, 5.0, 4.0, 0.5), workers);
    EXPECT_EQ(shallow.counts().too_deep, 0);
    EXPECT_GT(at_rest.n_pairs(), 10U);
    const Contacts through = found(deep, make_doublet(162, 3, 5.0, 4.0, 2.5), workers);
    EXPECT_GT(deep.counts().too_deep, 0);
    EXPECT_LE(largest_overlap_um(through), k_law.largest_overlap_um);
}

TEST(VariationalSearch, SeesTheDistanceOfTwoSpheresAsTheLargestOverlap) {
    // delta = 2 h0 - gap on the line of centres; the facets lie at most a sagitta inside the
    // spheres.
    for (const double gap_um : {0.1, 0.3, 0.5}) {
        Workers workers(1);
        VariationalSearch search(k_law, k_skin_um);
        const Contacts contacts = found(search, make_doublet(2562, 3, 5.0, 4.0, -gap_um), workers);
        EXPECT_NEAR(largest_overlap_um(contacts), 2.0 * k_law.h0_um - gap_um, 0.03);
    }
}

}  // namespace
}  // namespace spheroscope::test
