#include "tests/contact/random_triangles.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace spheroscope::test {
namespace {

constexpr double k_h0_um = 0.3;

/// Mean and standard error of a running sample.
struct Sample {
    double sum = 0.0, sum2 = 0.0;
    void add(double value) {
        sum += value;
        sum2 += value * value;
    }
    [[nodiscard]] double mean(double n) const { return sum / n; }
    [[nodiscard]] double standard_error(double n) const {
        return std::sqrt((sum2 / n - mean(n) * mean(n)) / n);
    }
};

TEST(MonteCarlo, FindsTheAreaForceAndNodalForcesOfTheKernelWithinThreeStandardErrors) {
    const ContactLaw law = adhesive_law(0.5, k_h0_um, 2.0, 0.0);
    const Random triangles(22, 5), points(23, 5);
    constexpr int n_points = 1'000'000;
    int n_pairs = 0, n_beyond = 0, n_compared = 0;
    std::uint64_t drawn = 0;
    for (std::uint64_t index = 0; n_pairs < 20; ++index) {
        const TrianglePair t = random_pair(triangles, index, Facing::tilted, k_h0_um);
        const TriangleGeometry a = triangle_of(t.a), b = triangle_of(t.b);
        ContactPair pair;
        if (contact_of_triangles(a, b, law, pair) != PairOutcome::active) continue;
        if (pair.area_um2 < 0.05) continue;  // too few points would hit it
        ++n_pairs;
        const Vec3& n = pair.normal;
        const double c = 0.5 * (b.normal - a.normal).norm();
        // Area of A seen along n; its points are hit evenly.
        const double seen_um2 = 0.5 * std::abs(n.dot((t.a[1] - t.a[0]).cross(t.a[2] - t.a[0])));
        Sample area, force;
        std::array<Sample, 3> nodal;
        for (int i = 0; i < n_points; ++i) {
            double s = points.uniform(drawn, 0), r = points.uniform(drawn, 1);
            ++drawn;
            if (s + r > 1.0) {
                s = 1.0 - s;
                r = 1.0 - r;
            }
            const std::array<double, 3> lambda{1.0 - s - r, s, r};
            const Vec3 x = t.a[0] + s * (t.a[1] - t.a[0]) + r * (t.a[2] - t.a[0]);
            // The point of B's plane over x, and whether it is in B.
            const double height = b.normal.dot(t.b[0] - x) / b.normal.dot(n);
            const Vec3 y = x + height * n;
            bool is_in_b = true;
            for (std::size_t k = 0; k < 3; ++k)
                is_in_b =
                    is_in_b && b.normal.dot((t.b[(k + 1) % 3] - t.b[k]).cross(y - t.b[k])) >= 0.0;
            const double overlap_um = height + 2.0 * law.h0_um / c;
            const bool is_in = is_in_b && overlap_um >= 0.0;
            const double pressure_kPa = is_in ? law.pressure_kPa(overlap_um) : 0.0;
            area.add(is_in ? seen_um2 : 0.0);
            force.add(seen_um2 * pressure_kPa);
            for (std::size_t k = 0; k < 3; ++k) nodal[k].add(seen_um2 * pressure_kPa * lambda[k]);
        }
        const auto compare = [&](const Sample& sample, double exact) {
            ++n_compared;
            const double error = std::abs(sample.mean(n_points) - exact);
            if (error > 3.0 * sample.standard_error(n_points)) ++n_beyond;
            // The chance of one in a hundred numbers beyond 4.5 standard errors is 7e-4.
            EXPECT_LE(error, 4.5 * sample.standard_error(n_points)) << "pair " << index;
        };
        compare(area, pair.area_um2);
        compare(force, pair.force_nN());
        for (std::size_t k = 0; k < 3; ++k) compare(nodal[k], pair.force_a_nN[k]);
    }
    // 0.27 % of normal numbers lie beyond three standard errors; the five of a pair go together.
    EXPECT_EQ(n_compared, 100);
    EXPECT_LE(n_beyond, 5);
}

}  // namespace
}  // namespace spheroscope::test
