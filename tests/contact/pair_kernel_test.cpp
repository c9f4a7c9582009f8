#include "engine/contact/contact_search.hpp"
#include "engine/contact/pair_kernel.hpp"
#include "engine/contact/simd_target.hpp"
#include "tests/contact/kernel_of_pair.hpp"
#include "tests/contact/random_triangles.hpp"
#include "tests/reference/all_pairs.hpp"
#include "tests/reference/compacted_ball.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <numbers>

namespace spheroscope::test {
namespace {

constexpr double k_h0_um = 0.3;

/// Every SIMD target of this machine, in both precisions.
class PairKernel : public testing::TestWithParam<std::tuple<std::string, ContactPrecision>> {
  protected:
    void SetUp() override { ASSERT_TRUE(use_simd_target(std::get<0>(GetParam()))); }
    void TearDown() override { ASSERT_TRUE(use_simd_target(simd_targets().front())); }

    [[nodiscard]] static ContactPrecision precision() { return std::get<1>(GetParam()); }
    [[nodiscard]] static bool is_single() {
        return precision() == ContactPrecision::single_precision;
    }
    /// The larger of the two numbers is for floats.
    [[nodiscard]] static double bound(double single, double dual) {
        return is_single() ? single : dual;
    }
    PairOutcome outcome(const TriangleGeometry& a, const TriangleGeometry& b,
                        ContactPair& pair) const {
        const double reach_um = contact_reach_um(law);
        return is_single() ? TwoTriangles<float>(a, b).outcome(law, reach_um, pair)
                           : TwoTriangles<double>(a, b).outcome(law, reach_um, pair);
    }
    /// Largest difference of areas, forces and area-weighted barycentric coordinates, relative to
    /// the size of triangle A. A pair that is not active has none of them.
    [[nodiscard]] double difference(const TrianglePair& t) const {
        const TriangleGeometry a = triangle_of(t.a), b = triangle_of(t.b);
        ContactPair plain{}, fast{};
        // Neither writes a pair that is not active.
        static_cast<void>(contact_of_triangles(a, b, law, plain));
        static_cast<void>(outcome(a, b, fast));
        const double size_um2 = 0.5 * (t.a[1] - t.a[0]).cross(t.a[2] - t.a[0]).norm();
        const double extent2 = std::max((t.a[1] - t.a[0]).squaredNorm(), size_um2);
        double most = std::abs(plain.area_um2 - fast.area_um2) / extent2;
        const double size_nN = law.P0_kPa * extent2;
        for (std::size_t i = 0; i < 3; ++i) {
            most = std::max(most, std::abs(plain.force_a_nN[i] - fast.force_a_nN[i]) / size_nN);
            most = std::max(most, std::abs(plain.force_b_nN[i] - fast.force_b_nN[i]) / size_nN);
        }
        return std::max(most, std::abs(plain.energy_fJ - fast.energy_fJ) / (size_nN * k_h0_um));
    }

    ContactLaw law = adhesive_law(0.5, k_h0_um, 2.0, 0.0);
};

TEST_P(PairKernel, AgreesWithTheScalarKernelOnTenThousandRandomPairs) {
    const Random random(31, 5);
    double most = 0.0;
    for (std::uint64_t index = 0; index < 2500; ++index)
        for (const Facing facing : k_all_facings)
            most = std::max(most, difference(random_pair(random, index, facing, k_h0_um)));
    EXPECT_LE(most, bound(2e-5, 1e-12));
    EXPECT_GT(most, 0.0) << "two roundings";
}

TEST_P(PairKernel, AgreesOnSlivers) {
    // One side of A a thousand times as long as its height; B as it is.
    const Random random(32, 5);
    double most = 0.0;
    int n_active = 0;
    for (std::uint64_t index = 0; index < 500; ++index) {
        TrianglePair t = random_pair(random, index, Facing::parallel, k_h0_um);
        for (Vec3& corner : t.a) corner.y() *= 1e-3;
        ContactPair pair;
        n_active += outcome(triangle_of(t.a), triangle_of(t.b), pair) == PairOutcome::active;
        most = std::max(most, difference(t));
    }
    EXPECT_GT(n_active, 300);
    EXPECT_LE(most, bound(2e-5, 1e-12));
}

TEST_P(PairKernel, SumsAFlatTriangleOverItsNeighboursAcrossSharedEdges) {
    // B in four pieces that share edges with each other and with A's projection: together they
    // cover A once, so the areas add up whatever the rounding of the common edges.
    const Random random(33, 5);
    for (std::uint64_t index = 0; index < 200; ++index) {
        const std::array<Vec3, 3> b = flat_triangle(random, index);
        const std::array<Vec3, 3> mid{0.5 * (b[0] + b[1]), 0.5 * (b[1] + b[2]),
                                      0.5 * (b[2] + b[0])};
        const std::array<std::array<Vec3, 3>, 4> pieces{{{b[0], mid[0], mid[2]},
                                                         {mid[0], b[1], mid[1]},
                                                         {mid[2], mid[1], b[2]},
                                                         {mid[0], mid[1], mid[2]}}};
        const std::array<Vec3, 3> a =
            moved(turned_over(b), Mat3::Identity(), Vec3(0.0, 0.0, k_h0_um));
        double area_um2 = 0.0;
        for (const auto& piece : pieces) {
            ContactPair pair{};
            if (outcome(triangle_of(a), triangle_of(piece), pair) == PairOutcome::active)
                area_um2 += pair.area_um2;
        }
        const double whole_um2 = 0.5 * (b[1] - b[0]).cross(b[2] - b[0]).norm();
        EXPECT_NEAR(area_um2, whole_um2, bound(5e-6, 1e-13) * whole_um2);
    }
}

TEST_P(PairKernel, CountsAPairOverItsLargestOverlap) {
    const std::array<Vec3, 3> b = flat_triangle(Random(34, 5), 3);
    const auto at_overlap = [&](double overlap_um) {
        const std::array<Vec3, 3> a =
            moved(turned_over(b), Mat3::Identity(), Vec3(0.0, 0.0, 2.0 * k_h0_um - overlap_um));
        ContactPair pair;
        return outcome(triangle_of(a), triangle_of(b), pair);
    };
    const double close_um = bound(1e-6, 1e-12);
    EXPECT_EQ(at_overlap(law.largest_overlap_um - close_um), PairOutcome::active);
    EXPECT_EQ(at_overlap(law.largest_overlap_um + close_um), PairOutcome::too_deep);
    EXPECT_EQ(at_overlap(close_um), PairOutcome::active);
    EXPECT_EQ(at_overlap(-close_um), PairOutcome::apart);
}

/// Contact forces on all nodes.
std::vector<Vec3> nodal_forces(const Cluster& cells, const Contacts& contacts) {
    std::vector<Vec3> F(cells.x_um.size(), Vec3::Zero());
    for (const Contacts::Group& group : contacts.groups)
        for (const ContactPair& pair : group.pairs)
            for (std::size_t i = 0; i < 3; ++i) {
                const auto node = [&](int cell, int triangle) -> Vec3& {
                    const auto& nodes =
                        cells.model.topology->triangles[static_cast<std::size_t>(triangle)];
                    return cells.model.cell_nodes(std::span<Vec3>(F),
                                                  cell)[static_cast<std::size_t>(nodes[i])];
                };
                node(group.cell_a, pair.triangle_a) += pair.force_a_nN[i] * pair.normal;
                node(group.cell_b, pair.triangle_b) -= pair.force_b_nN[i] * pair.normal;
            }
    return F;
}

TEST_P(PairKernel, HasTheNodalForcesOfTheScalarKernelOnACompactedBall) {
    const Cluster ball = make_compacted_ball(42, 3, 0.1, 0.05);
    const Geometry geometry = geometry_of(ball.model, ball.x_um, Need::triangles);
    Workers workers(1);
    ContactSearch search(law, precision());
    Contacts fast;
    search.find(ball.model, ball.x_um, geometry, workers, fast);
    const Contacts plain = reference::contacts_of_all_pairs(ball.model, ball.x_um, geometry, law);
    EXPECT_GT(plain.n_pairs(), 1000U);
    const std::vector<Vec3> F = nodal_forces(ball, fast), G = nodal_forces(ball, plain);
    double largest_nN = 0.0, error_nN = 0.0;
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < F.size(); ++i) {
        largest_nN = std::max(largest_nN, G[i].norm());
        error_nN = std::max(error_nN, (F[i] - G[i]).norm());
        sum += F[i];
    }
    EXPECT_LE(error_nN, bound(1e-5, 1e-13) * largest_nN);
    EXPECT_LE(sum.norm(), 1e-12 * largest_nN) << "pairs are balanced in double in any precision";
    // What the filter leaves is clipped, at five times the filter's price.
    const auto n_active = static_cast<std::int64_t>(plain.n_pairs());
    EXPECT_EQ(search.counts().active_pairs, n_active);
    EXPECT_LT(search.counts().candidates, n_active + n_active / 3);
}

TEST_P(PairKernel, GivesTheSameBitsOnAnyNumberOfThreads) {
    const Cluster ball = make_compacted_ball(42, 4, 0.1, 0.05);
    const Geometry geometry = geometry_of(ball.model, ball.x_um, Need::triangles);
    std::vector<Contacts> found;
    for (const int n_threads : {1, 2, 3, 16}) {
        Workers workers(n_threads);
        ContactSearch search(law, precision());
        search.find(ball.model, ball.x_um, geometry, workers, found.emplace_back());
    }
    for (const Contacts& contacts : found) {
        ASSERT_EQ(contacts.groups.size(), found[0].groups.size());
        for (std::size_t g = 0; g < contacts.groups.size(); ++g) {
            const auto &p = contacts.groups[g].pairs, &q = found[0].groups[g].pairs;
            ASSERT_EQ(p.size(), q.size());
            EXPECT_EQ(std::memcmp(p.data(), q.data(), p.size() * sizeof(ContactPair)), 0);
        }
    }
}

/// The pairs of two cells without the first n triangles of either, with indices as before.
template <class T> std::vector<ContactPair> pairs_without_first(const PackedTriangles<T>& all,
                                                                const std::vector<NodeBox>& boxes,
                                                                const ContactLaw& law,
                                                                std::size_t n) {
    PackedTriangles<T> part = all;
    part.n_triangles = all.n_triangles - n;
    const auto shift = [&](std::vector<T>& array, std::size_t width) {
        for (std::size_t cell = 0; cell < 2; ++cell)
            for (std::size_t i = 0; i < part.n_triangles * width; ++i)
                array[cell * part.n_triangles * width + i] =
                    array[(cell * all.n_triangles + n) * width + i];
    };
    shift(part.record, lanes::k_record);
    shift(part.reach_um, 1);
    for (std::size_t k = 0; k < 3; ++k) {
        shift(part.centroid_um[k], 1);
        shift(part.normal[k], 1);
    }
    KernelWorkspace<T> workspace;
    std::vector<ContactPair> pairs;
    static_cast<void>(
        find_pairs_of_cells(part, boxes, 0, 1, law, contact_reach_um(law), workspace, pairs));
    for (ContactPair& pair : pairs) {
        pair.triangle_a += static_cast<int>(n);
        pair.triangle_b += static_cast<int>(n);
    }
    return pairs;
}

template <class T> void expect_same_in_every_lane(const ContactLaw& law) {
    const Cluster doublet = make_doublet(162, 7, 5.0, 5.0, 0.3, 0.02);
    const Geometry geometry = geometry_of(doublet.model, doublet.x_um, Need::triangles);
    PackedTriangles<T> packed;
    packed.allocate(doublet.model);
    std::vector<NodeBox> boxes;
    for (int cell = 0; cell < 2; ++cell) {
        const NodeBox& box =
            boxes.emplace_back(doublet.model.cell_nodes(std::span<const Vec3>(doublet.x_um), cell));
        packed.pack_cell(doublet.model, doublet.x_um, geometry, cell, 0.5 * (box.low + box.high));
    }
    const std::vector<ContactPair> all = pairs_without_first(packed, boxes, law, 0);
    ASSERT_GT(all.size(), 30U);
    for (const std::size_t n : {1U, 3U, 8U}) {
        std::vector<ContactPair> expected;
        for (const ContactPair& pair : all)
            if (pair.triangle_a >= static_cast<int>(n) && pair.triangle_b >= static_cast<int>(n))
                expected.push_back(pair);
        ASSERT_GT(expected.size(), 10U) << n;
        const std::vector<ContactPair> pairs = pairs_without_first(packed, boxes, law, n);
        ASSERT_EQ(pairs.size(), expected.size());
        EXPECT_EQ(std::memcmp(pairs.data(), expected.data(), pairs.size() * sizeof(pairs[0])), 0);
    }
}

TEST_P(PairKernel, GivesAPairTheSameBitsInEveryLane) {
    if (is_single())
        expect_same_in_every_lane<float>(law);
    else
        expect_same_in_every_lane<double>(law);
}

INSTANTIATE_TEST_SUITE_P(All, PairKernel,
                         testing::Combine(testing::ValuesIn(simd_targets()),
                                          testing::Values(ContactPrecision::single_precision,
                                                          ContactPrecision::double_precision)),
                         [](const auto& tested) {
                             return std::get<0>(tested.param) +
                                    (std::get<1>(tested.param) == ContactPrecision::single_precision
                                         ? "_float"
                                         : "_double");
                         });

TEST(SimdTarget, IsOneOfThoseThatTheMachineHas) {
    const std::vector<std::string> targets = simd_targets();
    ASSERT_FALSE(targets.empty());
    EXPECT_EQ(targets.back(), "scalar") << "every machine has this one";
    for (const std::string& target : targets) {
        EXPECT_TRUE(use_simd_target(target));
        EXPECT_EQ(simd_target(), target);
        EXPECT_FALSE(use_simd_target("avx1024"));
        EXPECT_EQ(simd_target(), target) << "an unknown target changes nothing";
        EXPECT_EQ(simd_targets(), targets);
    }
    EXPECT_TRUE(use_simd_target(targets.front()));
}

}  // namespace
}  // namespace spheroscope::test
