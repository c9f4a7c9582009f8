// The law `variational` as a force: it is the gradient of its energy, and it acts between the cells
// and not on them together.
#include "engine/base/random.hpp"
#include "tests/reference/made_up_cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

namespace spheroscope::test {
namespace {

constexpr double k_h0_um = 0.3;

PartValues contact_alone() {
    PartValues values;
    values.contact = adhesive_law(0.5, k_h0_um, 2.0, 0.0);
    values.contact->form = ContactForm::variational;
    return values;
}

/// Energy and force of a configuration.
class Law {
  public:
    explicit Law(const Cluster& cells) : system_(cells.model, make_parts(contact_alone()), 1) {}
    double energy_fJ(std::span<const Vec3> x_um) {
        evaluate(x_um);
        return system_.energy_fJ();
    }
    std::span<const Vec3> force_nN(std::span<const Vec3> x_um) {
        evaluate(x_um);
        return system_.force_nN();
    }
    System& system() { return system_; }

  private:
    void evaluate(std::span<const Vec3> x_um) {
        const std::vector<double> no_integral(system_.model().radius_um.size(), 0.0);
        const auto trouble = system_.evaluate(x_um, no_integral, 0.0);
        ASSERT_FALSE(trouble.has_value());
    }
    System system_;
};

double dot(std::span<const Vec3> a, std::span<const Vec3> b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i].dot(b[i]);
    return sum;
}

std::vector<Vec3> shifted(std::span<const Vec3> x_um, double step,
                          std::span<const Vec3> direction) {
    std::vector<Vec3> result(x_um.begin(), x_um.end());
    for (std::size_t i = 0; i < result.size(); ++i) result[i] += step * direction[i];
    return result;
}

std::vector<Vec3> random_direction(std::size_t n, std::uint64_t seed) {
    const Random random(seed, 0);
    std::vector<Vec3> direction;
    for (std::size_t i = 0; i < n; ++i)
        direction.emplace_back(random.normal(i, 0), random.normal(i, 1), random.normal(i, 2));
    return direction;
}

/// Whether the force is the energy's slope along a random direction. Where the nearest point of a
/// sample jumps within the step, the energy has a kink, and its slopes to the two sides tell; then
/// nothing is compared, and the answer is false.
bool has_gradient(const Cluster& cells, std::uint64_t seed) {
    Law law(cells);
    const auto along = random_direction(cells.x_um.size(), seed);
    const double step_um = 2e-7;  // the smallest whose rounding is below the tolerance
    const double before = law.energy_fJ(shifted(cells.x_um, -step_um, along));
    const double after = law.energy_fJ(shifted(cells.x_um, step_um, along));
    const double here = law.energy_fJ(cells.x_um);
    const auto force = law.force_nN(cells.x_um);
    const double size = std::sqrt(dot(force, force));
    EXPECT_GT(size, 0.05) << "there must be a contact";
    if (std::abs(after - 2.0 * here + before) > 1e-4 * size * step_um) return false;
    EXPECT_NEAR(dot(force, along), (before - after) / (2.0 * step_um), 1e-7 * size)
        << "seed " << seed;
    return true;
}

TEST(VariationalLaw, IsTheGradientOfItsEnergyAtRandomStates) {
    int n_smooth = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed)
        n_smooth += has_gradient(
            make_doublet(162, seed, 5.0, 4.0, 0.1 * static_cast<double>(seed % 7), 0.05), seed);
    EXPECT_GE(n_smooth, 18);
}

TEST(VariationalLaw, IsTheGradientOfItsEnergyWhereManyCellsMeet) {
    int n_smooth = 0;
    for (std::uint64_t seed = 1; seed <= 5; ++seed)
        n_smooth += has_gradient(make_cluster(42, seed, 0.4, 0.05), seed);
    EXPECT_GE(n_smooth, 4);
}

/// Moves the second cell along the line of centres until the largest overlap of the two is this.
void set_largest_overlap(Cluster& cells, double wanted_um) {
    for (int round = 0; round < 20; ++round) {
        Law law(cells);
        static_cast<void>(law.force_nN(cells.x_um));
        double largest_um = -std::numeric_limits<double>::infinity();
        for (const Contacts::Group& group : law.system().contacts().groups)
            for (const ContactPair& pair : group.pairs)
                largest_um = std::max(largest_um, double{pair.largest_overlap_um});
        for (Vec3& x : cells.model.cell_nodes(std::span<Vec3>(cells.x_um), 1))
            x.z() += largest_um - wanted_um;
    }
}

TEST(VariationalLaw, IsTheGradientOfItsEnergyBesideTheKinksOfTheLaw) {
    // The first samples to touch are a thousandth of h0 beside the kink.
    for (const double kink_um : {0.0, k_h0_um, 2.0 * k_h0_um})
        for (const double side : {-1.0, 1.0}) {
            SCOPED_TRACE("delta = " + std::to_string(kink_um));
            const double wanted_um = kink_um + side * 1e-3 * k_h0_um;
            Cluster cells = make_doublet(162, 4, 5.0, 4.0, 0.0, 0.0);
            set_largest_overlap(cells, std::abs(wanted_um));
            if (wanted_um < 0.0)  // apart: nothing is found that one could aim at
                for (Vec3& x : cells.model.cell_nodes(std::span<Vec3>(cells.x_um), 1))
                    x.z() += 2.0 * std::abs(wanted_um);
            Law law(cells);
            const auto along = random_direction(cells.x_um.size(), 9);
            const auto force = law.force_nN(cells.x_um);
            const double power = dot(force, along), size = std::sqrt(dot(force, force));
            EXPECT_EQ(size > 0.0, wanted_um > 0.0);
            const double step_um = 2e-7;
            const double slope = (law.energy_fJ(shifted(cells.x_um, step_um, along)) -
                                  law.energy_fJ(shifted(cells.x_um, -step_um, along))) /
                                 (2.0 * step_um);
            EXPECT_NEAR(power, -slope, 1e-7 * std::max(size, 0.05));
        }
}

TEST(VariationalLaw, DoesNoWorkAroundAClosedLoop) {
    const Cluster cells = make_doublet(42, 6, 5.0, 4.0, 0.3, 0.03);
    Law law(cells);
    // One cell goes round on a circle across the contact, deeper and less deep, and back.
    // Small, so that no nearest point jumps on the way: the force would, and the sum with it.
    constexpr double radius_um = 2e-3;
    constexpr int n = 1000;
    double work = 0.0, size = 0.0;
    for (int k = 0; k < n; ++k) {
        const double angle = 2.0 * std::numbers::pi * (k + 0.5) / n;
        std::vector<Vec3> x = cells.x_um;
        for (Vec3& node : cells.model.cell_nodes(std::span<Vec3>(x), 1))
            node += radius_um * Vec3(1.0 - std::cos(angle), 0.0, std::sin(angle));
        const auto force = law.force_nN(x);
        Vec3 on_cell = Vec3::Zero();
        for (const Vec3& f : cells.model.cell_nodes(force, 1)) on_cell += f;
        const double part = on_cell.dot(Vec3(std::sin(angle), 0.0, std::cos(angle))) * radius_um *
                            2.0 * std::numbers::pi / n;
        work += part;
        size += std::abs(part);
    }
    EXPECT_GT(size, 1e-4);
    EXPECT_NEAR(work, 0.0, 1e-8 * size);
}

TEST(VariationalLaw, MakesNoNetForceAndNoTorque) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        const Cluster cells = make_cluster(162, seed, 0.4, 0.05);
        Law law(cells);
        const auto force = law.force_nN(cells.x_um);
        Vec3 sum = Vec3::Zero(), torque = Vec3::Zero();
        double size = 0.0, torque_size = 0.0;
        for (std::size_t i = 0; i < force.size(); ++i) {
            sum += force[i];
            torque += cells.x_um[i].cross(force[i]);
            size += force[i].norm();
            torque_size += cells.x_um[i].norm() * force[i].norm();
        }
        ASSERT_GT(size, 1.0);
        EXPECT_LT(sum.norm(), 1e-12 * size);
        EXPECT_LT(torque.norm(), 1e-12 * torque_size);
    }
}

TEST(VariationalLaw, StoresTheWorkOfAdhesionOnTheAreaOfAMatureContact) {
    // Where the surfaces touch all over, both sides together hold -W per area, and each a tension
    // of -W/2.
    const Cluster cells = make_doublet(642, 5, 5.0, 4.0, 0.0, 0.0);
    Law law(cells);
    static_cast<void>(law.force_nN(cells.x_um));
    const double W = law.system().parts().contact->work_of_adhesion_nN_per_um();
    double smallest = 0.0;
    for (const ContactFilm& film : law.system().contacts().groups.at(0).films_a)
        smallest = std::min(smallest, film.tension_nN_per_um);
    EXPECT_NEAR(smallest, -0.5 * W, 0.02 * W);
    EXPECT_GE(smallest, -0.5 * W * (1.0 + 1e-12)) << "e has its minimum -W";
}

TEST(VariationalLaw, AloneMakesFilms) {
    const Cluster cells = make_doublet(162, 6, 5.0, 4.0, 0.3, 0.0);
    Law law(cells);
    static_cast<void>(law.force_nN(cells.x_um));
    EXPECT_FALSE(law.system().contacts().groups.at(0).films_a.empty());
    PartValues traction = contact_alone();
    traction.contact->form = ContactForm::traction;
    System paper(cells.model, make_parts(traction), 1);
    const std::vector<double> no_integral(2, 0.0);
    ASSERT_FALSE(paper.evaluate(cells.x_um, no_integral, 0.0).has_value());
    EXPECT_FALSE(paper.contacts().groups.at(0).pairs.empty());
    EXPECT_TRUE(paper.contacts().groups.at(0).films_a.empty());
    EXPECT_TRUE(paper.contacts().groups.at(0).films_b.empty());
}

TEST(VariationalLaw, GivesTheImplicitMatrixAPositiveStiffnessAcrossTheContact) {
    const Cluster cells = make_doublet(162, 6, 5.0, 4.0, 0.3, 0.0);
    System system(cells.model, make_parts(contact_alone()), 1);
    const std::vector<double> no_integral(2, 0.0);
    ASSERT_FALSE(system.evaluate(cells.x_um, no_integral, 0.0).has_value());
    const auto work_of = [&](std::span<const Vec3> u, double dt_s) {
        std::vector<Vec3> product(u.size());
        system.velocity_system(dt_s, {}).product(u, product, system.workers());
        return dot(u, product);
    };
    // One cell moves towards the other: k times the area of the contact, and little else.
    std::vector<Vec3> towards(cells.x_um.size(), Vec3::Zero());
    for (Vec3& u : cells.model.cell_nodes(std::span<Vec3>(towards), 0)) u.z() = 1.0;
    double area_um2 = 0.0;
    for (const ContactPair& pair : system.contacts().groups.at(0).pairs) area_um2 += pair.area_um2;
    const double stiffness = work_of(towards, 1.0) - work_of(towards, 0.0);
    const double largest = system.parts().contact->k_kPa_per_um * area_um2;
    EXPECT_LT(stiffness, largest);
    EXPECT_GT(stiffness, 0.8 * largest);
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const auto u = random_direction(cells.x_um.size(), seed);
        EXPECT_GT(work_of(u, 1.0) - work_of(u, 0.0), 0.0);
    }
}

TEST(VariationalLaw, RunsToTheSameBitsOnAnyNumberOfThreads) {
    const Cluster cells = make_cluster(42, 21, 0.3, 0.05);
    PartValues values = case_a_values();
    values.contact->form = ContactForm::variational;
    const auto hash = [&](int n_threads) {
        System system(cells.model, make_parts(values), n_threads);
        MethodParameters parameters;
        parameters.dt_s = 2e-3;
        parameters.tolerance_um = 2e-3;
        const auto method = find_method("linearly_implicit")->make(parameters);
        State state = state_at(cells.model, cells.x_um);
        for (int step = 0; step < 10; ++step)
            EXPECT_TRUE(method->advance(system, state, 1e9, false).accepted);
        EXPECT_EQ(system.contacts().groups.size(), 6U);
        return state.hash();
    };
    const std::uint64_t alone = hash(1);
    for (const int n_threads : {2, 3, 16}) EXPECT_EQ(hash(n_threads), alone) << n_threads;
}

}  // namespace
}  // namespace spheroscope::test
