#include "engine/base/random.hpp"
#include "engine/contact/overlap_integral.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace spheroscope::test {
namespace {

const ContactLaw k_law = adhesive_law(0.5, 0.3, 2.0, 0.0);
using Corners = std::array<double, 3>;

/// The same integrals by the mid-points of n^2 small triangles.
OverlapIntegral by_midpoints(const Corners& d, int n) {
    OverlapIntegral sum;
    const auto add = [&](double u, double v) {
        const Corners lambda{1.0 - u - v, u, v};
        const double overlap = lambda[0] * d[0] + lambda[1] * d[1] + lambda[2] * d[2];
        if (overlap <= 0.0) return;
        const double weight = 1.0 / (double(n) * n);
        sum.energy_fJ_per_um2 += weight * k_law.energy_fJ_per_um2(overlap);
        for (std::size_t i = 0; i < 3; ++i) {
            sum.pressure_kPa[i] += weight * k_law.pressure_kPa(overlap) * lambda[i];
            sum.share[i] += weight * lambda[i];
        }
    };
    for (int row = 0; row < n; ++row)
        for (int column = 0; column < n - row; ++column) {
            add((column + 1.0 / 3.0) / n, (row + 1.0 / 3.0) / n);
            if (column + 1 < n - row) add((column + 2.0 / 3.0) / n, (row + 2.0 / 3.0) / n);
        }
    return sum;
}

TEST(OverlapIntegral, IsTheIntegralWhereverTheEdgeOfTheContactCutsTheTriangle) {
    const Random random(11, 0);
    for (std::uint64_t trial = 0; trial < 30; ++trial) {
        const Corners d{0.4 * random.normal(trial, 0), 0.4 * random.normal(trial, 1),
                        0.4 * random.normal(trial, 2)};
        const OverlapIntegral exact = integrate_overlap(d, k_law);
        const OverlapIntegral sum = by_midpoints(d, 200);
        // The cut triangles along the edge: one row of n out of n^2, with the jump P0 there.
        EXPECT_NEAR(exact.energy_fJ_per_um2, sum.energy_fJ_per_um2, 1e-4);
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_NEAR(exact.pressure_kPa[i], sum.pressure_kPa[i], 0.01 * k_law.P0_kPa);
            EXPECT_NEAR(exact.share[i], sum.share[i], 0.005);
        }
    }
}

void expect_gradient(const Corners& d, double step) {
    const OverlapIntegral at = integrate_overlap(d, k_law);
    for (std::size_t i = 0; i < 3; ++i) {
        Corners more = d, less = d;
        more[i] += step;
        less[i] -= step;
        const double slope = (integrate_overlap(more, k_law).energy_fJ_per_um2 -
                              integrate_overlap(less, k_law).energy_fJ_per_um2) /
                             (2.0 * step);
        EXPECT_NEAR(at.pressure_kPa[i], slope, 1e-7 * k_law.P0_kPa)
            << "corner " << i << " of (" << d[0] << ", " << d[1] << ", " << d[2] << ")";
    }
}

TEST(OverlapIntegral, HasItsPressureAsGradient) {
    const Random random(12, 0);
    for (std::uint64_t trial = 0; trial < 300; ++trial)
        expect_gradient({0.4 * random.normal(trial, 0), 0.4 * random.normal(trial, 1),
                         0.4 * random.normal(trial, 2)},
                        1e-6);
}

TEST(OverlapIntegral, HasItsPressureAsGradientBesideTheKinksOfTheLaw) {
    const double beside_um = 1e-3 * k_law.h0_um;
    for (const double kink_um : {0.0, k_law.h0_um, 2.0 * k_law.h0_um})
        for (const double side : {-1.0, 1.0}) {
            const double d = kink_um + side * beside_um;
            expect_gradient({d, d, d}, 1e-6);
            expect_gradient({d, d + 0.3, d + 0.1}, 1e-6);
            expect_gradient({d, d - 0.2, d - 0.4}, 1e-6);
        }
}

TEST(OverlapIntegral, IsContinuousToItsGradientWhereTheEdgeOfTheContactPassesACorner) {
    for (const Corners& others :
         {Corners{0.0, 0.2, 0.3}, Corners{0.0, -0.2, 0.3}, Corners{0.0, -0.2, -0.3}}) {
        const double step = 1e-9;
        const OverlapIntegral before = integrate_overlap({-step, others[1], others[2]}, k_law);
        const OverlapIntegral after = integrate_overlap({step, others[1], others[2]}, k_law);
        EXPECT_NEAR(before.energy_fJ_per_um2, after.energy_fJ_per_um2, 1e-7);
        for (std::size_t i = 0; i < 3; ++i)
            EXPECT_NEAR(before.pressure_kPa[i], after.pressure_kPa[i], 1e-6);
    }
}

}  // namespace
}  // namespace spheroscope::test
