#include "tests/scene/scene_text.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace spheroscope::scene {
namespace {

Scene read(const std::string& text, const std::vector<Override>& overrides = {}) {
    return parse_scene(text, "a.toml", overrides);
}

std::string adhesion(const std::string& contact_keys, const std::string& adhesion_keys) {
    return with(with(k_doublet, "[contact]\n", "[contact]\n" + contact_keys + "\n"),
                "omega = \"0.5 nN/um\"", adhesion_keys);
}

/// Two cells and the given stages.
std::string with_stages(const std::string& stages) {
    return with(k_doublet, "[[stage]]\nkind = \"relax\"\nduration = \"1 s\"\n", stages);
}

std::string packing(const std::string& stages) {
    return with(with_stages(stages), "\"pair\"\nradius = \"9 um\"", "\"packing\"\ncount = 5");
}

TEST(SceneResolution, EachReadingOfOmegaGivesItsWorkOfAdhesionAndOverlap) {
    // P0 = 2 W / d and k = 2 W / d^2 with d = overlap * h0; printed: P0 = omega / h0, k = omega /
    // h0^2
    struct Row {
        const char* reading;
        double W, overlap;
    };
    for (const Row& row : {Row{"printed", 0.25, 1}, Row{"text", 0.5, 2}, Row{"two_sided", 0.5, 1},
                           Row{"per_cell", 1.0, 2}}) {
        const Scene scene = read(adhesion(std::string("omega_reading = \"") + row.reading + "\"",
                                          "omega = \"0.5 nN/um\""));
        EXPECT_EQ(scene.contact->W_nN_per_um, row.W) << row.reading;
        EXPECT_EQ(scene.contact->equilibrium_overlap_h0, row.overlap) << row.reading;
        EXPECT_EQ(scene.contact->omega_nN_per_um, 0.5);
    }
    EXPECT_EQ(read(k_doublet).contact->omega_reading, OmegaReading::text);
}

TEST(SceneResolution, AGivenWorkOfAdhesionIsTakenAsItIs) {
    const Scene scene = read(adhesion("", "W = \"0.3 mN/m\"\nequilibrium_overlap = 1"));
    EXPECT_EQ(scene.contact->W_nN_per_um, 0.3);
    EXPECT_EQ(scene.contact->equilibrium_overlap_h0, 1.0);
    EXPECT_EQ(scene.contact->omega_reading, OmegaReading::work_of_adhesion);
    EXPECT_EQ(scene.contact->omega_nN_per_um, 0.0);
    EXPECT_EQ(read(adhesion("", "W = 0.3")).contact->equilibrium_overlap_h0, 2.0);
    EXPECT_EQ(refusal(adhesion("omega_reading = \"text\"", "W = 0.3")),
              "a.toml:21:1: error: contact.omega_reading says how to read omega, but "
              "contact.adhesion.W is given\n"
              "  hint: leave it out, or give contact.adhesion.omega");
    EXPECT_EQ(refusal(adhesion("omega_reading = \"work_of_adhesion\"", "omega = 0.3")),
              "a.toml:21:1: error: contact.omega_reading = \"work_of_adhesion\" wants "
              "contact.adhesion.W");
    EXPECT_EQ(refusal(adhesion("", "omega = 0.3\nequilibrium_overlap = 1")),
              "a.toml:25:1: error: contact.adhesion.equilibrium_overlap does not apply here: it "
              "belongs with W");
}

TEST(SceneResolution, ARangeOfAdhesionThatTheMeshCannotCarryIsRefusedUnlessItIsAllowed) {
    const std::string text = refusal(adhesion("h0 = \"100 nm\"", "omega = \"0.5 nN/um\""));
    EXPECT_EQ(
        text,
        "a.toml:21:1: error: contact.h0 = 0.1 um is too small for the mesh: edges are 2.7 um "
        "long with cells.nodes = 162, and the rim of a contact catches on them below 0.14 um\n"
        "  hint: a finer mesh, or contact.allow_coarse_mesh = true for contacts that stay too "
        "small");
    const std::vector<Override> finer{{"cells.nodes", "642"}};
    EXPECT_EQ(read(adhesion("h0 = \"100 nm\"", "omega = 0.5"), finer).contact->h0_um, 0.1);
    const std::vector<Override> allowed{{"contact.allow_coarse_mesh", "true"}};
    EXPECT_EQ(read(adhesion("h0 = \"30 nm\"", "omega = 0.5"), allowed).contact->h0_um, 0.03);
}

TEST(SceneResolution, RatiosOfThePaperGiveItsTableExactly) {
    const auto ratios = [](double gamma_over_omega, double Et_over_omega) {
        return read(with(
            with(k_doublet, "E = \"20 kPa\"", "Et_over_omega = " + std::to_string(Et_over_omega)),
            "omega = \"0.5 nN/um\"", "gamma_over_omega = " + std::to_string(gamma_over_omega)));
    };
    EXPECT_EQ(ratios(1, 8).cortex.elastic->E_kPa, 20.0);
    EXPECT_EQ(ratios(1, 8).contact->omega_nN_per_um, 0.5);
    EXPECT_EQ(ratios(4, 8).cortex.elastic->E_kPa, 5.0);
    EXPECT_EQ(ratios(4, 8).contact->omega_nN_per_um, 0.125);
    EXPECT_EQ(ratios(1, 0.125).cortex.elastic->E_kPa, 0.3125);
    EXPECT_EQ(ratios(1, 0.125).cortex.bending->E_kPa, 0.3125);
}

TEST(SceneResolution, RatiosWithoutTheirReferenceAreRefused) {
    EXPECT_EQ(refusal(with(adhesion("", "W = 0.5"), "E = \"20 kPa\"", "Et_over_omega = 8")),
              "a.toml:6:1: error: cortex.elastic.Et_over_omega needs contact.adhesion.omega");
    EXPECT_EQ(refusal(with(with(adhesion("", "gamma_over_omega = 1"),
                                "[cortex.tension]\ngamma = \"0.5 nN/um\"", ""),
                           "[cytosol]", "[cytosol]\nT_I = 1")),
              "a.toml:24:1: error: contact.adhesion.gamma_over_omega needs [cortex.tension]");
}

TEST(SceneResolution, TimesOfThePaperFollowFromTensionAndViscosity) {
    const Scene scene = read(k_doublet);
    // printed: T_I = 0.115 s, T_d = 1.15 s, dt = 3.85 ms
    EXPECT_NEAR(scene.cytosol->T_I_s, 0.2 / (std::sqrt(3.0) * 2.0 * 0.5), 1e-15);
    EXPECT_EQ(scene.cytosol->T_d_s, 10.0 * scene.cytosol->T_I_s);
    EXPECT_NEAR(scene.method.dt_s, 3.849e-3, 1e-6);
    EXPECT_EQ(read(k_drop).method.dt_s, 1e-3);
    EXPECT_EQ(refusal(with(k_drop, "[medium]", "[cytosol]\n[medium]")),
              "a.toml:8:1: error: cytosol.T_I is missing; its default needs [cortex.tension] and "
              "[cortex.viscosity]\n  hint: typical: 0.115 s");
    EXPECT_EQ(refusal(k_drop + "[method]\ndt = 2\n"),
              "a.toml:13:1: error: method: dt (2 s) must lie between dt_min (1e-06 s) and dt_max "
              "(1 s)");
}

TEST(SceneResolution, AdhesionBeyondFullWettingIsAnErrorUnlessAllowed) {
    const std::string text = adhesion("omega_reading = \"per_cell\"", "omega = \"0.6 nN/um\"");
    EXPECT_EQ(refusal(text),
              "a.toml:23:1: error: W = 1.2 nN/um (omega_reading = \"per_cell\") is above 2 gamma = "
              "1 nN/um: cells flatten without limit\n"
              "  hint: allow it with scene.allow_full_wetting = true");
    EXPECT_TRUE(read("[scene]\nallow_full_wetting = true\n" + text).warnings.empty());
    const std::string without_tension =
        with(with(k_doublet, "[cortex.tension]\ngamma = \"0.5 nN/um\"", ""), "[cytosol]", "");
    EXPECT_EQ(refusal(without_tension),
              "a.toml:21:1: error: W = 0.5 nN/um (omega_reading = \"text\") has no "
              "[cortex.tension] to resist it: cells flatten without limit\n"
              "  hint: allow it with scene.allow_full_wetting = true");
}

TEST(SceneResolution, AdhesionAtFullWettingWarns) {
    const Scene scene = read(adhesion("", "gamma_over_omega = 0.5"));
    ASSERT_EQ(scene.warnings.size(), 1U);
    EXPECT_EQ(scene.warnings[0],
              "a.toml:23:1: W = 1 nN/um (omega_reading = \"text\") equals 2 gamma: full "
              "wetting, contacts have no tension left");
    EXPECT_TRUE(read(k_doublet).warnings.empty());
}

TEST(SceneResolution, ContactWithoutAdhesionOnlyRepelsAndNeedsItsStiffness) {
    const std::string repulsive =
        with(k_doublet, "[contact]\n\n[contact.adhesion]\nomega = \"0.5 nN/um\"", "[contact]\n");
    EXPECT_EQ(refusal(repulsive),
              "a.toml:20:1: error: contact.repulsion_k is missing; it is required without "
              "[contact.adhesion], which brings its own stiffness\n"
              "  hint: typical: 2.8 kPa/um");
    const Scene scene = read(with(repulsive, "[contact]", "[contact]\nrepulsion_k = \"3 kPa/um\""));
    EXPECT_FALSE(scene.contact->adhesive);
    EXPECT_EQ(scene.contact->repulsion_k_kPa_per_um, 3.0);
    EXPECT_TRUE(read(k_doublet).contact->adhesive);
}

TEST(SceneResolution, TheStrainLimiterTakesWhatTheSpringsLack) {
    const auto guarded = [](const char* E) {
        return read(with(with(k_doublet, "20 kPa", E), "[cytosol]",
                         "[cortex.regularisation]\n\n[cytosol]"));
    };
    EXPECT_EQ(guarded("0.3125 kPa").cortex.regularisation->kappa_nN_per_um, 0.1875);
    EXPECT_TRUE(guarded("0.3125 kPa").warnings.empty());
    EXPECT_EQ(guarded("20 kPa").cortex.regularisation->kappa_nN_per_um, 0.0);
    ASSERT_EQ(guarded("20 kPa").warnings.size(), 1U);
    EXPECT_EQ(guarded("20 kPa").warnings[0],
              "a.toml:16:1: [cortex.regularisation] has kappa = 0 and does nothing (E t = "
              "4 nN/um, gamma = 0.5 nN/um)");
    EXPECT_EQ(refusal(with(k_drop, "[medium]", "[cortex.regularisation]\n[medium]")),
              "a.toml:8:1: error: [cortex.regularisation] needs [cortex.elastic] and "
              "[cortex.tension]");
}

TEST(SceneResolution, BendingWithoutElasticityNeedsItsModulus) {
    EXPECT_EQ(refusal(with(k_drop, "[medium]", "[cortex.bending]\n[medium]")),
              "a.toml:8:1: error: cortex.bending.E is missing; it is required without "
              "[cortex.elastic]");
    EXPECT_EQ(read(k_doublet).cortex.bending->E_kPa, 20.0);
}

TEST(SceneResolution, PartsThatDoNotFitEachOtherAreRefused) {
    EXPECT_EQ(refusal(with(k_doublet, "\"pair\"", "\"single\"")),
              "a.toml:20:1: error: a single cell has nothing to touch: remove [contact]");
    EXPECT_EQ(refusal(with(k_drop, "[medium]", "")),
              "a.toml: error: the table [medium] is missing: without drag the velocities of cells "
              "are not defined\n  hint: [medium] with eta_f = \"0.05 kPa s\" is the paper's");
    EXPECT_EQ(refusal(k_drop + "[load.body_force]\nforce = [1, 0, 0]\nopposed = true\n"),
              "a.toml:15:1: error: load.body_force.opposed wants two cells, got 1");
    EXPECT_EQ(
        refusal(with(k_drop, "[cortex", "[cortex]\nthickness = \"9 um\"\n[cortex")),
        "a.toml:6:1: error: cortex.thickness (9 um) must be below the smallest radius (9 um)");
    EXPECT_EQ(refusal(with(k_drop, "radius = \"9 um\"", "radius = { min = 9, max = 8 }")),
              "a.toml:3:10: error: cells.radius.min (9 um) must be below cells.radius.max (8 um)");
    EXPECT_EQ(refusal(with(k_drop, "radius = \"9 um\"", "radius = { scale = \"0.5 um\" }")),
              "a.toml:3:10: error: the mean radius shape * scale = 18.88 um must lie between min = "
              "5 um and max = 13 um");
}

TEST(SceneResolution, StagesThatCannotFollowEachOtherAreRefused) {
    const std::string compact = "[[stage]]\nkind = \"compact\"\nduration = 5\n";
    const std::string hold = "[[stage]]\nkind = \"hold\"\nduration = 1\n";
    const std::string release = "[[stage]]\nkind = \"release\"\nduration = 1\n";
    const std::string relax = "[[stage]]\nkind = \"relax\"\nuntil = \"rest\"\n";
    const std::string anneal = "[[stage]]\nkind = \"anneal\"\n";
    EXPECT_EQ(refusal(packing(anneal + compact + hold + release + relax)), "accepted");
    EXPECT_EQ(refusal(with_stages(compact + release + relax)), "accepted");
    EXPECT_EQ(refusal(with_stages("")),
              "a.toml: error: the scene has no [[stage]]: nothing would happen");
    EXPECT_EQ(
        refusal(packing(relax)),
        "a.toml:25:1: error: arrangement = \"packing\" wants a stage of kind \"anneal\" first, "
        "which packs the beads");
    EXPECT_EQ(refusal(with_stages(anneal)),
              "a.toml:25:1: error: a stage of kind \"anneal\" packs beads: it belongs to "
              "arrangement = \"packing\"");
    EXPECT_EQ(refusal(packing(anneal + anneal)),
              "a.toml:27:1: error: a stage of kind \"anneal\" can only be the first");
    EXPECT_EQ(
        refusal(with_stages(release)),
        "a.toml:25:1: error: a stage of kind \"release\" must follow \"compact\" or \"hold\": "
        "there is no wall");
    EXPECT_EQ(refusal(with_stages(compact + relax)),
              "a.toml:28:1: error: the wall is still there: a stage of kind \"release\" must come "
              "before this one");
    EXPECT_EQ(
        refusal(with(k_drop, "[[stage]]", compact + "[[stage]]")),
        "a.toml:10:1: error: compact, hold and release need [contact]: cells without it would "
        "be pressed through each other");
}

TEST(SceneResolution, AStageIsOnTheCoarserOfItsMeshAndTheCells) {
    const std::string stages = "[[stage]]\nkind = \"relax\"\nduration = \"1 s\"\nnodes = 162\n"
                               "[[stage]]\nkind = \"relax\"\nduration = \"1 s\"\n";
    for (const int nodes : {42, 162, 642}) {
        const Scene scene =
            parse_scene(with_stages(stages), "a.toml", {{"cells.nodes", std::to_string(nodes)}});
        EXPECT_EQ(scene.stages[0].nodes, std::min(nodes, 162));
        EXPECT_EQ(scene.stages[1].nodes, nodes);
    }
}

TEST(SceneResolution, FieldsOfPicturesAreMeasured) {
    const Scene scene = read(k_drop + "[measures]\nfields = [\"a\"]\n[[picture]]\nfield = \"b\"\n"
                                      "[[picture]]\nname = \"second\"\nfield = \"a\"\n");
    EXPECT_EQ(scene.measures.fields, (std::vector<std::string>{"a", "b"}));
}

TEST(SceneResolution, AnAxisToTurnAboutIsADirection) {
    EXPECT_EQ(refusal(k_drop + "[start]\nturn_axis = [0, 0, 0]\n"),
              "a.toml:14:1: error: start.turn_axis wants a vector that is not zero");
}

TEST(SceneResolution, PicturesThatContradictThemselvesAreRefused) {
    EXPECT_EQ(refusal(k_drop + "[[picture]]\nname = \"all\"\n"),
              "a.toml:13:1: error: no picture can be named \"all\": --picture all means each one");
    EXPECT_EQ(refusal(k_drop + "[[picture]]\n[[picture]]\n"),
              "a.toml:14:1: error: two pictures have the name \"main\"");
    EXPECT_EQ(refusal(k_drop + "[[picture]]\nname = \"a/b\"\n"),
              "a.toml:13:1: error: a picture's name is made of letters, digits, '_' and '-', as it "
              "names files; got \"a/b\"");
    EXPECT_EQ(refusal(k_drop + "[[picture]]\nnetwork = true\n"),
              "a.toml:13:1: error: picture.network draws contact forces: it needs [contact]");
    EXPECT_EQ(refusal(k_drop + "[[picture]]\nrange = \"given\"\ngiven_range = [1, 1]\n"),
              "a.toml:13:1: error: picture.given_range wants [lowest, highest], got [1, 1]");
}

TEST(SceneResolution, ExpectationsComeAsBoundsOrAsValueAndWidth) {
    const Scene scene = read(k_drop + "[expect]\nP = { value = -2, relative = 0.25 }\n"
                                      "A = { value = 1, tolerance = 0.5 }\nZ = { min = 6 }\n");
    ASSERT_EQ(scene.expect.size(), 3U);
    EXPECT_EQ(scene.expect[0].measure, "P");
    EXPECT_EQ(scene.expect[0].min, -2.5);
    EXPECT_EQ(scene.expect[0].max, -1.5);
    EXPECT_EQ(scene.expect[1].min, 0.5);
    EXPECT_EQ(scene.expect[1].max, 1.5);
    EXPECT_EQ(scene.expect[2].min, 6.0);
    EXPECT_TRUE(std::isinf(scene.expect[2].max));
    const std::string wants = " wants min and max (or one of them), or value with tolerance or "
                              "relative";
    for (const char* bad : {"{ }", "{ value = 1 }", "{ value = 1, tolerance = 1, relative = 1 }",
                            "{ min = 1, value = 1, tolerance = 1 }", "{ min = 1, relative = 1 }"})
        EXPECT_EQ(refusal(k_drop + "[expect]\nP = " + bad + "\n"),
                  "a.toml:14:1: error: expect.P" + wants)
            << bad;
    EXPECT_EQ(refusal(k_drop + "[expect]\nP = { min = 2, max = 1 }\n"),
              "a.toml:14:1: error: expect.P: min (2) is above max (1)");
}

TEST(SceneResolution, CentresAreRowsOfPositionAndRadius) {
    const Scene scene = read(with(k_drop, "\"single\"\nradius = \"9 um\"",
                                  "\"centres\"\ncentres = [[0, 0, 0, 9], [\"18 um\", 0, 0, 8]]"));
    ASSERT_EQ(scene.cells.count, 2);
    EXPECT_EQ(scene.cells.centres_um[1], (std::array<double, 4>{18, 0, 0, 8}));
    EXPECT_EQ(refusal(with(k_drop, "\"single\"\nradius = \"9 um\"",
                           "\"centres\"\ncentres = [[0, 0, 0, 0]]")),
              "a.toml:3:1: error: cells.centres: the radius of row 0 must be > 0, got 0 um");
    EXPECT_EQ(refusal(with(k_drop, "\"single\"\nradius = \"9 um\"", "\"centres\"\ncentres = []")),
              "a.toml:3:1: error: cells.centres wants one row [x, y, z, radius] or more, got none");
}

TEST(OnMesh, MovesStagesOfTheOwnMeshAndKeepsCoarserOnes) {
    const Scene scene =
        parse_scene(with(with(k_doublet, "[[stage]]",
                              "[[stage]]\nkind = \"relax\"\nnodes = 162\nduration = 1\n[[stage]]"),
                         "[cells]\n", "[cells]\nnodes = 642\n"),
                    "a.toml");
    ASSERT_EQ(scene.stages.size(), 2U);
    const Scene finer = on_mesh(scene, 2562), coarser = on_mesh(scene, 42);
    EXPECT_EQ(finer.cells.nodes, 2562);
    EXPECT_EQ(finer.stages[0].nodes, 162);
    EXPECT_EQ(finer.stages[1].nodes, 2562);
    EXPECT_EQ(coarser.stages[0].nodes, 42);
    EXPECT_EQ(coarser.stages[1].nodes, 42);
}

}  // namespace
}  // namespace spheroscope::scene
