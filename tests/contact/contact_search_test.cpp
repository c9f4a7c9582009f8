#include "engine/base/random.hpp"
#include "engine/contact/contact_search.hpp"
#include "tests/reference/all_pairs.hpp"
#include "tests/reference/made_up_cells.hpp"

#include <gtest/gtest.h>

#include <cstring>

namespace spheroscope::test {
namespace {

const ContactLaw k_law = adhesive_law(0.5, 0.3, 2.0, 0.0);

/// What a search finds now, with its own lists if it has any.
Contacts found(ContactSearch& search, const Cluster& cells, Workers& workers) {
    const Geometry geometry = geometry_of(cells.model, cells.x_um, Need::triangles);
    Contacts contacts;
    search.find(cells.model, cells.x_um, geometry, workers, contacts);
    return contacts;
}

Contacts found_anew(const Cluster& cells, const ContactLaw& law,
                    ContactPrecision precision = ContactPrecision::single_precision) {
    ContactSearch search(law, precision);
    Workers workers(1);
    return found(search, cells, workers);
}

Contacts brute_force(const Cluster& cells, const ContactLaw& law) {
    return reference::contacts_of_all_pairs(
        cells.model, cells.x_um, geometry_of(cells.model, cells.x_um, Need::triangles), law);
}

/// All bits of all pairs, and the way in which they are grouped.
bool are_same_bits(const Contacts& p, const Contacts& q) {
    static_assert(sizeof(ContactPair) == 2 * sizeof(int) + 2 * sizeof(float) + 17 * sizeof(double),
                  "no padding");
    const auto equal = [](const auto& a, const auto& b) {
        return a.size() == b.size() &&
               (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0);
    };
    const auto equal_groups = [&] {
        if (p.groups.size() != q.groups.size()) return false;
        for (std::size_t g = 0; g < p.groups.size(); ++g)
            if (p.groups[g].cell_a != q.groups[g].cell_a ||
                p.groups[g].cell_b != q.groups[g].cell_b ||
                !equal(p.groups[g].pairs, q.groups[g].pairs))
                return false;
        return true;
    };
    const auto equal_sides = [&] {
        if (p.cell_sides.size() != q.cell_sides.size()) return false;
        for (std::size_t s = 0; s < p.cell_sides.size(); ++s)
            if (p.cell_sides[s].group != q.cell_sides[s].group ||
                p.cell_sides[s].is_a != q.cell_sides[s].is_a)
                return false;
        return true;
    };
    return equal_groups() && equal(p.cell_begin, q.cell_begin) && equal_sides();
}

/// The same pairs with the same areas, to the rounding of doubles.
void expect_same_pairs(const Contacts& p, const Contacts& q) {
    ASSERT_EQ(p.groups.size(), q.groups.size());
    for (std::size_t g = 0; g < p.groups.size(); ++g) {
        ASSERT_EQ(p.groups[g].pairs.size(), q.groups[g].pairs.size()) << "group " << g;
        for (std::size_t i = 0; i < p.groups[g].pairs.size(); ++i) {
            const ContactPair &s = p.groups[g].pairs[i], &t = q.groups[g].pairs[i];
            EXPECT_EQ(s.triangle_a, t.triangle_a);
            EXPECT_EQ(s.triangle_b, t.triangle_b);
            EXPECT_NEAR(s.area_um2, t.area_um2, 1e-13);
            EXPECT_NEAR(s.force_nN(), t.force_nN(), 1e-13);
        }
    }
}

/// Every node goes its own way, by up to `step_um` in each direction.
void wander(Cluster& cells, std::uint64_t step, double step_um) {
    const Random random(step, 33);
    for (std::size_t i = 0; i < cells.x_um.size(); ++i)
        for (std::uint32_t k = 0; k < 3; ++k)
            cells.x_um[i][k] += step_um * (2.0 * random.uniform(i, k) - 1.0);
}

TEST(ContactSearch, FindsWhatAllPairsOfTrianglesGive) {
    for (const double overlap_um : {-0.4, 0.2, 0.9}) {
        const Cluster cells = make_cluster(162, 11, overlap_um, 0.05);
        const Contacts contacts = found_anew(cells, k_law, ContactPrecision::double_precision);
        expect_same_pairs(contacts, brute_force(cells, k_law));
        EXPECT_GT(contacts.n_pairs(), 10U) << "overlap " << overlap_um;
    }
}

TEST(ContactSearch, FindsDeepContactsOfFineMeshesWithAShortRange) {
    // Surfaces up to 1 um inside each other are contacts whatever h0 is; here that is five times 2
    // h0.
    ContactLaw law = adhesive_law(0.5, 0.1, 2.0, 0.0);
    for (const double overlap_um : {0.5, 0.8, 1.0, 1.1}) {
        const Cluster cells = make_doublet(642, 5, 5.0, 5.0, overlap_um);
        SCOPED_TRACE(overlap_um);
        expect_same_pairs(found_anew(cells, law, ContactPrecision::double_precision),
                          brute_force(cells, law));
    }
}

TEST(ContactSearch, DoesNotDependOnWhatItFoundBefore) {
    Cluster cells = make_cluster(42, 12, 0.2);
    ContactSearch search(k_law, ContactPrecision::single_precision);
    Workers workers(1);
    constexpr int n_steps = 60;
    for (int step = 0; step < n_steps; ++step) {
        wander(cells, static_cast<std::uint64_t>(step), 0.02);
        ASSERT_TRUE(are_same_bits(found(search, cells, workers), found_anew(cells, k_law)))
            << "step " << step;
    }
}

TEST(ContactSearch, GivesTheSameBitsOnAnyNumberOfThreads) {
    const Cluster start = make_cluster(162, 13, 0.3, 0.05);
    const Contacts expected = found_anew(start, k_law);
    for (const int n_threads : {2, 3, 16}) {
        Workers workers(n_threads);
        ContactSearch search(k_law, ContactPrecision::single_precision);
        EXPECT_TRUE(are_same_bits(found(search, start, workers), expected)) << n_threads;
    }
}

TEST(ContactSearch, OrdersPairsByCellsAndTriangles) {
    const Contacts contacts = found_anew(make_cluster(162, 14, 0.3), k_law);
    ASSERT_EQ(contacts.groups.size(), 6U) << "every cell touches every other one";
    for (std::size_t g = 0; g < contacts.groups.size(); ++g) {
        const Contacts::Group& group = contacts.groups[g];
        EXPECT_LT(group.cell_a, group.cell_b);
        EXPECT_FALSE(group.pairs.empty());
        if (g > 0) {
            const Contacts::Group& before = contacts.groups[g - 1];
            EXPECT_LT(std::pair(before.cell_a, before.cell_b),
                      std::pair(group.cell_a, group.cell_b));
        }
        const auto pairs = contacts.pairs_of(group);
        for (std::size_t p = 1; p < pairs.size(); ++p)
            EXPECT_LT(std::pair(pairs[p - 1].triangle_a, pairs[p - 1].triangle_b),
                      std::pair(pairs[p].triangle_a, pairs[p].triangle_b));
    }
    for (int cell = 0; cell < 4; ++cell) {
        ASSERT_EQ(contacts.sides_of(cell).size(), 3U);
        for (const Contacts::Side& side : contacts.sides_of(cell)) {
            const Contacts::Group& group = contacts.groups[static_cast<std::size_t>(side.group)];
            EXPECT_EQ(side.is_a ? group.cell_a : group.cell_b, cell);
        }
    }
}

TEST(ContactSearch, CountsWhatItFindsAndWhatIsTooDeep) {
    Workers workers(1);
    {
        const Cluster cells = make_cluster(162, 15, 0.3);
        ContactSearch search(k_law, ContactPrecision::single_precision);
        const auto n_pairs = static_cast<std::int64_t>(found(search, cells, workers).n_pairs());
        EXPECT_EQ(search.counts().active_pairs, n_pairs);
        EXPECT_GE(search.counts().candidates, n_pairs);
        EXPECT_EQ(search.counts().too_deep, 0);
        static_cast<void>(found(search, cells, workers));
        EXPECT_EQ(search.counts().active_pairs, 2 * n_pairs);
    }
    {
        // Far apart: nothing to look at.
        ContactSearch search(k_law, ContactPrecision::single_precision);
        EXPECT_EQ(found(search, make_cluster(162, 15, -8.0), workers).n_pairs(), 0U);
        EXPECT_EQ(search.counts().candidates, 0);
    }
    {
        // Two micrometres in each other: the middle of the contact is deeper than 1 um.
        ContactSearch search(k_law, ContactPrecision::single_precision);
        EXPECT_GT(found(search, make_doublet(162, 3, 5.0, 5.0, 2.0), workers).n_pairs(), 0U);
        EXPECT_GT(search.counts().too_deep, 0);
    }
}

TEST(ContactSearch, RepulsionAloneHasNoTension) {
    const Cluster cells = make_cluster(162, 16, 0.5);
    const Contacts contacts = found_anew(cells, repulsive_law(5.0, 0.3, 0.0));
    ASSERT_EQ(contacts.groups.size(), 6U);
    for (const Contacts::Group& group : contacts.groups)
        for (const ContactPair& pair : group.pairs) {
            EXPECT_GT(pair.force_nN(), 0.0);
            for (std::size_t i = 0; i < 3; ++i) {
                EXPECT_GE(pair.force_a_nN[i], -1e-6);
                EXPECT_GE(pair.force_b_nN[i], -1e-6);
            }
        }
}

}  // namespace
}  // namespace spheroscope::test
