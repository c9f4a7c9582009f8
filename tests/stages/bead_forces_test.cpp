#include "engine/base/random.hpp"
#include "engine/stages/bead_forces.hpp"
#include "engine/stages/bead_packing.hpp"

#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

namespace spheroscope {
namespace {

constexpr double k_centring = 0.03;

struct Case {
    const char* name;
    BeadBox box;
};
std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }

/// 60 beads of mean radius about 1 that fill the box to about 0.6, so that many overlap.
struct Beads {
    std::vector<double> radius;
    std::vector<Vec3> x;
};

Beads random_beads(const BeadBox& box, std::uint64_t seed) {
    Beads beads;
    beads.radius = draw_radii({}, 60, seed);
    for (double& r : beads.radius) r /= 9.06;
    const Random random(seed, 77);
    for (std::uint64_t i = 0; i < 60; ++i) {
        // A cube across the wall of the sphere; in the periodic box, three cubes wide.
        const double width = box.boundary == BeadBoundary::sphere ? 1.6 * box.size : 3.0 * box.size;
        beads.x.push_back(width * Vec3(random.uniform(i, 0) - 0.5, random.uniform(i, 1) - 0.5,
                                       random.uniform(i, 2) - 0.5));
    }
    return beads;
}

/// The plain twin: energy over stiffness, from all pairs and all images in reach.
double energy(const Beads& beads, const BeadBox& box) {
    double sum = 0.0;
    const int reach = box.boundary == BeadBoundary::periodic ? 4 : 0;
    const int side = 2 * reach + 1;
    for (std::size_t i = 0; i < beads.x.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            for (int image = 0; image < side * side * side; ++image) {
                const Vec3 cube(image % side - reach, image / side % side - reach,
                                image / (side * side) - reach);
                const double distance = (beads.x[i] - beads.x[j] - box.size * cube).norm();
                const double overlap = beads.radius[i] + beads.radius[j] - distance;
                if (overlap > 0.0) sum += 0.5 * overlap * overlap;
            }
        }
        if (box.boundary == BeadBoundary::sphere) {
            const double outside = beads.x[i].norm() + beads.radius[i] - box.size;
            if (outside > 0.0) sum += 0.5 * outside * outside;
            sum += 0.5 * k_centring * beads.x[i].squaredNorm();
        }
    }
    return sum;
}

class BeadForcesIn : public testing::TestWithParam<Case> {};

TEST_P(BeadForcesIn, AreTheDownhillSlopeOfTheEnergyOfAllPairs) {
    const BeadBox box = GetParam().box;
    Beads beads = random_beads(box, 3);
    BeadForces forces(beads.radius, box, k_centring);
    std::vector<Vec3> force(beads.x.size());
    forces.compute(beads.x, force);
    ASSERT_GT(forces.contacts(beads.x).size(), 60U);
    const double h = 1e-5;
    for (const std::size_t i : {0U, 17U, 31U, 59U}) {
        for (int axis = 0; axis < 3; ++axis) {
            const double at = beads.x[i][axis];
            beads.x[i][axis] = at + h;
            const double up = energy(beads, box);
            beads.x[i][axis] = at - h;
            const double down = energy(beads, box);
            beads.x[i][axis] = at;
            // Truncation: h^2 times a third derivative of up to 10. Rounding: 1e-16 E / h = 1e-9.
            EXPECT_NEAR(force[i][axis], -(up - down) / (2.0 * h), 2e-8) << i << " " << axis;
        }
    }
}

TEST_P(BeadForcesIn, DoNotDependOnTheAgeOfTheList) {
    const BeadBox box = GetParam().box;
    Beads beads = random_beads(box, 5);
    BeadForces aged(beads.radius, box, k_centring);
    std::vector<Vec3> force(beads.x.size()), fresh_force(beads.x.size());
    const Random random(5, 78);
    constexpr int n_steps = 200;
    for (int step = 0; step < n_steps; ++step) {
        for (std::size_t i = 0; i < beads.x.size(); ++i) {
            const auto index = static_cast<std::uint64_t>(step) * 60 + i;
            beads.x[i] += 0.01 * Vec3(random.normal(index, 0), random.normal(index, 1),
                                      random.normal(index, 2));
        }
        aged.compute(beads.x, force);
        BeadForces fresh(beads.radius, box, k_centring);
        fresh.compute(beads.x, fresh_force);
        for (std::size_t i = 0; i < force.size(); ++i) ASSERT_EQ(force[i], fresh_force[i]) << step;
    }
    // 0.02 per step against half a skin, 0.15: the list was renewed, but seldom.
    EXPECT_GT(aged.n_lists(), 3);
    EXPECT_LT(aged.n_lists(), n_steps / 4);
}

TEST_P(BeadForcesIn, ContactsAreThePairsThatPush) {
    const BeadBox box = GetParam().box;
    const Beads beads = random_beads(box, 8);
    const BeadForces forces(beads.radius, box);
    double pair_energy = 0.0;
    for (const BeadContact& c : forces.contacts(beads.x)) {
        ASSERT_LT(c.i, c.j);
        pair_energy += 0.5 * c.overlap * c.overlap;
    }
    BeadBox open = box;
    if (open.boundary == BeadBoundary::sphere) open.size = 1e3;  // no wall
    double expected = energy(beads, open);
    if (open.boundary == BeadBoundary::sphere) {
        for (const Vec3& x : beads.x) expected -= 0.5 * k_centring * x.squaredNorm();
    }
    EXPECT_NEAR(pair_energy, expected, 1e-10);
}

INSTANTIATE_TEST_SUITE_P(Boxes, BeadForcesIn,
                         testing::Values(Case{"Sphere", {BeadBoundary::sphere, 4.7}},
                                         Case{"Periodic", {BeadBoundary::periodic, 7.5}}),
                         [](const auto& instance) { return std::string(instance.param.name); });

TEST(PeriodicBeads, PushEachOtherWithoutNetForce) {
    const BeadBox box{BeadBoundary::periodic, 7.5};
    const Beads beads = random_beads(box, 4);
    BeadForces forces(beads.radius, box);
    std::vector<Vec3> force(beads.x.size());
    forces.compute(beads.x, force);
    Vec3 sum = Vec3::Zero();
    for (const Vec3& f : force) sum += f;
    EXPECT_GT(largest_norm(force), 0.1);
    EXPECT_LT(sum.norm(), 1e-13 * 60 * largest_norm(force));
}

TEST(BeadWall, PushesABeadBackByItsProtrusion) {
    BeadForces forces({1.0}, {BeadBoundary::sphere, 5.0});
    std::vector<Vec3> force(1);
    forces.compute(std::vector<Vec3>{Vec3(0.0, 4.25, 0.0)}, force);
    EXPECT_EQ(force[0], Vec3(0.0, -0.25, 0.0));
    forces.compute(std::vector<Vec3>{Vec3(0.0, 3.75, 0.0)}, force);
    EXPECT_EQ(force[0], Vec3::Zero());
}

}  // namespace
}  // namespace spheroscope
