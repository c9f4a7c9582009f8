// One contact as an object: its numbers against closed forms, against what the run itself wrote,
// and against the laws of mechanics.
#include "engine/inspect/inspect_contact.hpp"
#include "tests/inspect/small_runs.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace spheroscope::inspect {
namespace {

using test::PairScene;
using test::run_scene_text;
using test::SmallRun;
using test::text_of;
using Detail = FrameSystem::Detail;

constexpr double k_R_um = 9.0, k_h0_um = 0.3;

ContactReport report_of(const SmallRun& run, int frame, const ContactKey& key = {0, 1}) {
    FrameSystem system(run.header, {}, Detail::contacts);
    system.load(run.frames[static_cast<std::size_t>(frame)]);
    return inspect_contact(system, key);
}

TEST(Contact, OfTwoSpheresPressedByAKnownOverlapIsTheCapOfThatDepth) {
    // Spheres that touch: the overlap is delta0 = 2 h0 on the axis and 2 h0 - r^2/R beside it, so
    // the patch has the area pi R delta0 and the mean overlap delta0 / 2, both to the order of
    // delta0/R; the facets add d^2/8R = 2.5 % of R-scale gaps to each surface.
    PairScene scene;
    scene.nodes = 642;
    scene.centre_distance_um = 2.0 * k_R_um;
    scene.stages = "[[stage]]\nkind = \"relax\"\nduration = 1e-4\nevery = 1e-4\n";
    const SmallRun run = run_scene_text(text_of(scene));
    const ContactSummary s = report_of(run, 0).summary;
    const double delta0_um = 2.0 * k_h0_um;
    EXPECT_TRUE(s.exists);
    EXPECT_NEAR(s.area_um2 / (M_PI * k_R_um * delta0_um), 1.0, 0.1);
    EXPECT_NEAR(s.mean_overlap_um / (0.5 * delta0_um), 1.0, 0.1);
    EXPECT_NEAR(s.largest_overlap_um / delta0_um, 1.0, 0.1);
    EXPECT_NEAR(s.mean_overlap_h0, s.mean_overlap_um / k_h0_um, 1e-12);
    EXPECT_NEAR(s.largest_overlap_h0, s.largest_overlap_um / k_h0_um, 1e-12);
    // Derjaguin: P0 delta0 - k delta0^2 / 2 = W on the axis, so the pull is pi R W.
    EXPECT_NEAR(s.normal_force_nN / (-M_PI * k_R_um * 0.5), 1.0, 0.12);
    EXPECT_LT(s.shear_force_nN, 0.1 * std::abs(s.normal_force_nN));
    EXPECT_EQ(s.Z_a, 1);
    EXPECT_EQ(s.Z_b, 1);
}

TEST(Contact, HasTheForceAndAreaThatTheRunItselfWrote) {
    for (const char* law : {"traction", "variational"}) {
        PairScene scene;
        scene.law = law;
        const SmallRun run = run_scene_text(text_of(scene));
        for (int frame = 0; frame < run.n_frames(); ++frame) {
            SCOPED_TRACE(law + std::to_string(frame));
            const auto& links = run.frames[static_cast<std::size_t>(frame)]->links;
            ASSERT_EQ(links.size(), 1U);
            const ContactSummary s = report_of(run, frame).summary;
            // Positions in single precision move overlaps by 1e-6 um, of 0.3.
            EXPECT_NEAR(s.centre_force_nN, double{links[0].force_nN},
                        1e-4 * std::abs(double{links[0].force_nN}));
            EXPECT_NEAR(s.area_um2, double{links[0].area_um2}, 1e-4 * s.area_um2);
        }
    }
}

TEST(Contact, ForcesAndMomentsOfBothCellsCancel) {
    for (const char* law : {"traction", "variational"}) {
        SCOPED_TRACE(law);
        PairScene scene;
        scene.law = law;
        const Balance balance = report_of(run_scene_text(text_of(scene)), 1).balance;
        // The kernel of `traction` works in floats.
        EXPECT_LT(balance.force_sum_nN.norm(), 1e-6 * balance.force_scale_nN);
        EXPECT_LT(balance.moment_sum_nN_um.norm(), 1e-5 * balance.moment_scale_nN_um);
        EXPECT_GT(balance.force_on_a_nN.norm(), 0.01 * balance.force_scale_nN);
    }
}

TEST(Contact, MapIsWhatTheKernelIntegratesAndItsPressureIsTheLaws) {
    const ContactReport report = report_of(run_scene_text(text_of({})), 1);
    ASSERT_GT(report.map.size(), 20U);
    double area_um2 = 0.0, force_nN = 0.0;
    for (const MapPolygon& polygon : report.map) {
        double twice_area = 0.0;
        const std::size_t n = polygon.corners.size();
        ASSERT_GE(n, 3U);
        EXPECT_EQ(polygon.quadrature.size(), 3 * (n - 2));
        for (std::size_t i = 0; i < n; ++i) {
            const PlanePoint &p = polygon.corners[i], &q = polygon.corners[(i + 1) % n];
            twice_area += p.u_um * q.v_um - q.u_um * p.v_um;
            EXPECT_GE(p.overlap_um, -1e-12);
        }
        // Each polygon lies in its own plane, tilted by some degrees to the mean one.
        EXPECT_NEAR(0.5 * std::abs(twice_area), polygon.area_um2, 0.05 * polygon.area_um2 + 1e-4);
        area_um2 += polygon.area_um2;
        force_nN += polygon.area_um2 * polygon.pressure_kPa;
    }
    EXPECT_NEAR(area_um2, report.summary.area_um2, 1e-9 * area_um2);
    EXPECT_NEAR(force_nN, report.summary.normal_force_nN, 0.02 * std::abs(force_nN));
    EXPECT_LT(report.largest_deviation_kPa, 1e-4 * report.P0_kPa);
    ASSERT_GT(report.section.size(), 4U);
    for (std::size_t i = 1; i < report.section.size(); ++i)
        EXPECT_LT(report.section[i - 1].u_low_um, report.section[i].u_high_um);
}

TEST(Contact, OfAStageOnACoarserMeshIsLookedAtOnThatMesh) {
    PairScene scene;
    scene.stages = "[[stage]]\nkind = \"relax\"\nduration = 0.1\nevery = 0.1\nnodes = 42\n"
                   "[[stage]]\nkind = \"relax\"\nduration = 0.1\nevery = 0.1\n";
    const SmallRun run = run_scene_text(text_of(scene));
    const ContactReport coarse = report_of(run, 1), fine = report_of(run, 2);
    EXPECT_EQ(coarse.mesh_nodes, 42);
    EXPECT_EQ(fine.mesh_nodes, 162);
    const ContactLink& link = run.frames[1]->links.at(0);
    EXPECT_NEAR(coarse.summary.area_um2, double{link.area_um2}, 1e-4 * double{link.area_um2});
    EXPECT_NEAR(coarse.summary.centre_force_nN, double{link.force_nN},
                1e-3 * std::abs(double{link.force_nN}));
}

TEST(Contact, ThatIsNotThereNamesTheNearestOnes) {
    PairScene scene;
    scene.cells = ", [0, 60, 9, 9]";
    const SmallRun run = run_scene_text(text_of(scene));
    const auto message = [&](const ContactKey& key) -> std::string {
        try {
            static_cast<void>(report_of(run, 0, key));
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_EQ(message({1, 2}), "error: cells 1 and 2 do not touch in frame 0\n"
                               "  hint: nearest contacts: 0-1");
    EXPECT_EQ(message({1, 3}), "error: there is no cell 3\n"
                               "  hint: the run has 3 cells, counted from 0");
}

TEST(Contact, IsNamedByTwoCellsInAnyOrder) {
    EXPECT_EQ(parse_contact("42-17"), (ContactKey{17, 42}));
    EXPECT_EQ(parse_contact("17-42").text(), "17-42");
    for (const char* text : {"", "17", "17-", "-17", "17-17", "a-b", "17-42x", "1 - 2", "1--2"})
        EXPECT_THROW(static_cast<void>(parse_contact(text)), Error) << text;
}

TEST(Contacts, OfAFrameComeLargestForceFirst) {
    PairScene scene;
    scene.cells = ", [0, 17.9, 9, 9], [0, 18.2, -9, 9]";
    const SmallRun run = run_scene_text(text_of(scene));
    FrameSystem system(run.header, {}, Detail::contacts);
    system.load(run.last());
    const std::vector<ContactSummary> rows = contacts_of(system);
    ASSERT_EQ(rows.size(), run.last()->links.size());
    ASSERT_EQ(rows.size(), 4U);
    for (std::size_t i = 1; i < rows.size(); ++i)
        EXPECT_GE(std::abs(rows[i - 1].centre_force_nN), std::abs(rows[i].centre_force_nN));
    for (const ContactSummary& row : rows) {
        EXPECT_EQ(row.Z_a, 2);
        // Two cells alone have the same numbers.
        FrameSystem pair(run.header, {row.key.cell_a, row.key.cell_b}, Detail::contacts);
        pair.load(run.last());
        const ContactSummary alone = summarize(pair, row.key);
        EXPECT_EQ(alone.normal_force_nN, row.normal_force_nN);
        EXPECT_EQ(alone.area_um2, row.area_um2);
        EXPECT_EQ(alone.key, row.key);
    }
}

TEST(NodeForces, OfTermsAndFrictionAddUpToZero) {
    PairScene scene;
    const SmallRun run = run_scene_text(text_of(scene));
    FrameSystem system(run.header, {}, Detail::forces);
    system.load(run.last());
    int n_touching = 0;
    for (int node = 0; node < 162; node += 7) {
        const NodeForces forces = forces_on_node(system, 1, node);
        EXPECT_LT(forces.residual_nN.norm(), 1e-5 * forces.scale_nN) << node;
        EXPECT_GT(forces.drive_nN.norm(), 10.0 * forces.residual_nN.norm()) << node;
        Vec3 sum = Vec3::Zero();
        for (const NodeForce& row : forces.terms) {
            sum += row.force_nN;
            if (row.name == "contact with cell 0") ++n_touching;
        }
        const Vec3 whole = system.system().force_nN()[static_cast<std::size_t>(162 + node)];
        EXPECT_LT((sum - whole).norm(), 1e-12 * forces.scale_nN) << node;
        ASSERT_EQ(forces.frictions.size(), 4U);
    }
    EXPECT_GT(n_touching, 0);
    EXPECT_LT(n_touching, 20);
}

TEST(NodeForces, HaveThePressureThatTheRunHadAtThatTime) {
    const SmallRun run = run_scene_text(text_of({}));
    FrameSystem system(run.header, {}, Detail::forces);
    system.load(run.last());
    const CytosolPressure* cytosol = system.system().parts().cytosol;
    for (int cell = 0; cell < 2; ++cell) {
        const double wanted = double{run.last()->pressure_kPa[static_cast<std::size_t>(cell)]};
        EXPECT_NEAR(cytosol->pressure_kPa(system.system().configuration(), cell), wanted,
                    1e-6 * wanted);
    }
    EXPECT_THROW(static_cast<void>(forces_on_node(system, 2, 0)), Error);
    EXPECT_THROW(static_cast<void>(forces_on_node(system, 0, 162)), Error);
}

TEST(NodeForces, AreRefusedWhereTheVelocitiesCannotBeSolvedFor) {
    const SmallRun run = run_scene_text(text_of({}));
    // So stiff that no digits are left of the friction with the medium.
    const auto header = std::make_shared<RunHeader>(*run.header);
    header->resolved_scene = scene::parse_scene(run.header->resolved_scene, "stiff",
                                                {{"medium.eta_f", "1e-9 kPa s"},
                                                 {"contact.friction.normal", "1e9 kPa s/um"},
                                                 {"contact.friction.tangential", "1e9 kPa s/um"}})
                                 .resolved_toml;
    FrameSystem system(header, {}, Detail::forces);
    system.load(run.last());
    try {
        static_cast<void>(forces_on_node(system, 0, 0));
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::not_converged);
        EXPECT_STREQ(error.what(), "error: the velocities of frame 2 could not be solved for");
    }
}

}  // namespace
}  // namespace spheroscope::inspect
