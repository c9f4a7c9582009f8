// What a contact does to a body that is carried round a closed loop and comes back to where it
// began. A force that is the gradient of an energy does no work in total. The paper's force (law
// `traction`) is no such gradient: it leaves out what the area's derivative gives.
#include "tests/contact/random_triangles.hpp"
#include "tests/reference/made_up_cells.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <iostream>
#include <numbers>

namespace spheroscope::test {
namespace {

constexpr double k_h0_um = 0.3, k_W_nN_per_um = 0.5;

/// Where the carried body is: turned about y by the tilt, then moved.
struct Pose {
    double tilt_rad, gap_um, slide_um;
    [[nodiscard]] Vec3 at(const Vec3& x) const {
        return Eigen::AngleAxisd(tilt_rad, Vec3::UnitY()) * x + Vec3(slide_um, 0.0, gap_um);
    }
};

/// A loop at the scale of the law's range: gap and slide swing by h0/2, the tilt by 0.1, out of
/// phase. phase in [0, 1].
Pose on_the_loop(const Pose& centre, double phase) {
    const double angle = 2.0 * std::numbers::pi * phase;
    return {centre.tilt_rad + 0.1 * std::sin(angle),
            centre.gap_um + 0.5 * k_h0_um * std::cos(angle),
            centre.slide_um + 0.5 * k_h0_um * std::sin(angle + 1.0)};
}

/// Work of the contact on the carried body, fJ.
struct Work {
    double loop_fJ = 0.0;  ///< what is left of it
    double path_fJ = 0.0;  ///< its sizes summed
};

/// force: on the nodes of the body in this pose, nN. The force in the middle of each step.
Work carry(const std::vector<Vec3>& body_um, const std::function<Pose(double)>& pose, int n_steps,
           const std::function<std::vector<Vec3>(const Pose&)>& force) {
    Work work;
    for (int k = 0; k < n_steps; ++k) {
        const Pose from = pose(double(k) / n_steps), to = pose(double(k + 1) / n_steps);
        const std::vector<Vec3> F = force(pose((k + 0.5) / n_steps));
        double step_fJ = 0.0;
        for (std::size_t i = 0; i < body_um.size(); ++i)
            step_fJ += F[i].dot(to.at(body_um[i]) - from.at(body_um[i]));
        work.loop_fJ += step_fJ;
        work.path_fJ += std::abs(step_fJ);
    }
    return work;
}

/// Two facets of side 1.5 um: A lies still and looks up, B looks down on it.
struct TwoFacets {
    ContactLaw law = adhesive_law(k_W_nN_per_um, k_h0_um, 2.0, 0.0);
    TriangleGeometry a =
        triangle_of({Vec3(-0.75, -0.45, 0.0), Vec3(0.75, -0.45, 0.0), Vec3(0.0, 0.85, 0.0)});
    std::vector<Vec3> b_um{Vec3(-0.75, -0.45, 0.0), Vec3(0.0, 0.85, 0.0), Vec3(0.75, -0.45, 0.0)};

    [[nodiscard]] std::vector<Vec3> force_on_b_nN(const Pose& pose) const {
        const TriangleGeometry b =
            triangle_of({pose.at(b_um[0]), pose.at(b_um[1]), pose.at(b_um[2])});
        ContactPair pair;
        std::vector<Vec3> F(3, Vec3::Zero());
        if (contact_of_triangles(a, b, law, pair) != PairOutcome::active) return F;
        for (std::size_t k = 0; k < 3; ++k)
            F[k] = -double{pair.force_b_nN[k]} * Vec3(pair.normal.cast<double>());
        return F;
    }
    [[nodiscard]] double area_um2(const Pose& pose) const {
        ContactPair pair;
        const TriangleGeometry b =
            triangle_of({pose.at(b_um[0]), pose.at(b_um[1]), pose.at(b_um[2])});
        EXPECT_EQ(contact_of_triangles(a, b, law, pair), PairOutcome::active);
        return pair.area_um2;
    }
};

// C-9. In and out over different areas: with parallel facets what is left is a closed form.
TEST(LoopOfTwoFacets, InThePapersLawLeavesWhatTheForgottenTangentialTensionWouldTake) {
    const TwoFacets facets;
    const double deep_um = 0.1, high_um = 0.5, aside_um = 0.3;
    const auto rectangle = [&](double phase) {  // out, aside, in, back
        const double s = 4.0 * phase;
        if (s <= 1.0) return Pose{0.0, deep_um + (high_um - deep_um) * s, 0.0};
        if (s <= 2.0) return Pose{0.0, high_um, aside_um * (s - 1.0)};
        if (s <= 3.0) return Pose{0.0, high_um - (high_um - deep_um) * (s - 2.0), aside_um};
        return Pose{0.0, deep_um, aside_um * (4.0 - s)};
    };
    const auto force = [&](const Pose& pose) { return facets.force_on_b_nN(pose); };
    const Work work = carry(facets.b_um, rectangle, 4000, force);
    const auto energy = [&](double gap_um) {
        return facets.law.energy_fJ_per_um2(2.0 * k_h0_um - gap_um);
    };
    const double lost_area_um2 =
        facets.area_um2({0.0, deep_um, 0.0}) - facets.area_um2({0.0, deep_um, aside_um});
    const double expected_fJ = lost_area_um2 * (energy(deep_um) - energy(high_um));
    EXPECT_GT(lost_area_um2, 0.1);
    EXPECT_NEAR(work.loop_fJ, expected_fJ, 1e-9 * std::abs(expected_fJ));
}

TEST(LoopOfTwoFacets, WithATiltLeavesAShareOfItsWorkInThePapersLaw) {
    const TwoFacets facets;
    const auto force = [&](const Pose& pose) { return facets.force_on_b_nN(pose); };
    const auto pose = [](double phase) { return on_the_loop({0.2, k_h0_um, 0.2}, phase); };
    const double WS_fJ = k_W_nN_per_um * facets.area_um2({0.0, k_h0_um, 0.0});
    const Work coarse = carry(facets.b_um, pose, 500, force);
    const Work fine = carry(facets.b_um, pose, 4000, force);
    std::cout << "traction: " << fine.loop_fJ << " fJ of " << fine.path_fJ << " fJ on the way ("
              << 100.0 * std::abs(fine.loop_fJ) / fine.path_fJ << " %), "
              << 100.0 * std::abs(fine.loop_fJ) / WS_fJ << " % of W S\n";
    EXPECT_NEAR(coarse.loop_fJ, fine.loop_fJ, 0.01 * std::abs(fine.loop_fJ)) << "not of the steps";
    EXPECT_GT(std::abs(fine.loop_fJ), 1e-3 * fine.path_fJ);
    EXPECT_LT(std::abs(fine.loop_fJ), 0.2 * fine.path_fJ);
}

// A rigid cell over another one, in the law that is a gradient: nothing is left but the steps' own
// error, and kinks of the energy, where the nearest point of a sample jumps.
TEST(LoopOfTwoCells, LeavesNothingInTheVariationalLaw) {
    PartValues values;
    values.contact = adhesive_law(k_W_nN_per_um, k_h0_um, 2.0, 0.0);
    values.contact->form = ContactForm::variational;
    const Cluster cells = make_doublet(42, 1, 5.0, 4.0, 0.0);
    System system(cells.model, make_parts(values), 1);
    const std::vector<double> no_integral(2, 0.0);
    std::vector<Vec3> x_um = cells.x_um;
    const auto carried = cells.model.cell_nodes(std::span<const Vec3>(cells.x_um), 1);
    Vec3 centre_um = Vec3::Zero();
    for (const Vec3& x : carried) centre_um += x / double(carried.size());
    std::vector<Vec3> body_um;
    for (const Vec3& x : carried) body_um.push_back(x - centre_um);
    const auto force = [&](const Pose& pose) {
        const auto moved = cells.model.cell_nodes(std::span<Vec3>(x_um), 1);
        for (std::size_t i = 0; i < body_um.size(); ++i) moved[i] = centre_um + pose.at(body_um[i]);
        EXPECT_FALSE(system.evaluate(x_um, no_integral, 0.0).has_value());
        const auto F = cells.model.cell_nodes(system.force_nN(), 1);
        return std::vector<Vec3>(F.begin(), F.end());
    };
    const auto pose = [](double phase) { return on_the_loop({0.0, 0.0, 0.0}, phase); };
    // Kinks of the energy, met at random, make the error of a step: it falls, but not evenly.
    double first = 0.0, last = 0.0;
    for (const int n_steps : {25, 100, 400, 1600}) {
        const Work work = carry(body_um, pose, n_steps, force);
        last = std::abs(work.loop_fJ) / work.path_fJ;
        if (n_steps == 25) first = last;
        std::cout << "variational, " << n_steps << " steps: " << work.loop_fJ << " fJ of "
                  << work.path_fJ << " fJ on the way, " << last << "\n";
        EXPECT_GT(work.path_fJ, 1.0);
    }
    EXPECT_LT(first, 1e-3);
    EXPECT_LT(last, 1e-5);
    EXPECT_LT(last, first / 10.0);
}

}  // namespace
}  // namespace spheroscope::test
