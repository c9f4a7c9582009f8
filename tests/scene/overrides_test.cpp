#include "tests/scene/scene_text.hpp"

#include <gtest/gtest.h>

namespace spheroscope::scene {
namespace {

Scene read(const std::string& text, const std::vector<Override>& overrides) {
    return parse_scene(text, "a.toml", overrides);
}

TEST(SceneOverrides, TomlValuesAndBareTextAreTaken) {
    const Scene scene = read(k_doublet, {{"cells.nodes", "642"},
                                         {"cortex.elastic.E", "5 kPa"},
                                         {"contact.adhesion.omega", "\"0.125 nN/um\""},
                                         {"stage[0].duration", "2.5"},
                                         {"measures.fields", "[\"sigma_h\"]"}});
    EXPECT_EQ(scene.cells.nodes, 642);
    EXPECT_EQ(scene.cortex.elastic->E_kPa, 5.0);
    EXPECT_EQ(scene.contact->W_nN_per_um, 0.125);
    EXPECT_EQ(scene.stages[0].duration_s, 2.5);
    EXPECT_EQ(scene.measures.fields, std::vector<std::string>{"sigma_h"});
}

TEST(SceneOverrides, TheLastOneWins) {
    EXPECT_EQ(read(k_drop, {{"cells.nodes", "642"}, {"cells.nodes", "42"}}).cells.nodes, 42);
}

TEST(SceneOverrides, ATableThatIsNotThereIsMadeAndAddsThePart) {
    EXPECT_FALSE(read(k_drop, {}).cortex.viscosity.has_value());
    const Scene scene = read(k_drop, {{"cortex.viscosity.eta", "1 kPa s"}});
    ASSERT_TRUE(scene.cortex.viscosity.has_value());
    EXPECT_EQ(scene.cortex.viscosity->eta_kPa_s, 1.0);
    EXPECT_EQ(scene.cortex.viscosity->loc.text(), "--set cortex.viscosity.eta=1 kPa s");
}

TEST(SceneOverrides, OneOfSeveralExclusiveKeysReplacesTheOthersOfTheFile) {
    const Scene scene = read(k_doublet, {{"contact.adhesion.gamma_over_omega", "4"},
                                         {"cortex.elastic.Et_over_omega", "8"}});
    EXPECT_EQ(scene.contact->omega_nN_per_um, 0.125);
    EXPECT_EQ(scene.cortex.elastic->E_kPa, 5.0);
    EXPECT_EQ(
        refusal(k_doublet, {{"contact.adhesion.W", "0.2"}, {"contact.adhesion.omega", "0.2"}}),
        "--set contact.adhesion.W=0.2: error: [contact.adhesion] wants exactly one of "
        "omega, gamma_over_omega, W, got omega and W");
}

TEST(SceneOverrides, AFixedRadiusReplacesADistributionAndTheOtherWayRound) {
    const std::string distributed =
        with(k_drop, "radius = \"9 um\"", "radius = { min = 6, max = 12 }");
    EXPECT_EQ(read(distributed, {{"cells.radius", "7 um"}}).cells.radius.fixed_um, 7.0);
    EXPECT_EQ(read(k_drop, {{"cells.radius", "{ min = 6 }"}}).cells.radius.min_um, 6.0);
}

TEST(SceneOverrides, MistakesNameTheOverride) {
    EXPECT_EQ(refusal(k_drop, {{"cells.nodes", "abc"}}),
              "--set cells.nodes=abc: error: cells.nodes wants an integer, got \"abc\"\n"
              "  typical: 162 (quick), 642 (chosen here)");
    EXPECT_EQ(refusal(k_drop, {{"cells.nods", "162"}}),
              "--set cells.nods=162: error: unknown key 'nods' in [cells]; did you mean 'nodes'?");
    EXPECT_EQ(refusal(k_drop, {{"cortex.tension.gamma", "20 kPa"}}),
              "--set cortex.tension.gamma=20 kPa: error: cortex.tension.gamma wants a tension "
              "(nN/um), got \"20 kPa\" (a stiffness or a pressure)\n"
              "  typical: 0.5 nN/um (Cuvelier et al. 2021, Table 2)");
    EXPECT_EQ(refusal(k_drop, {{"cells", "5"}}), "--set cells=5: error: [cells] is a table, got 5");
    EXPECT_EQ(refusal(k_drop, {{"cells.count", "5"}}),
              "--set cells.count=5: error: cells.count does not apply here: it belongs with "
              "arrangement = \"packing\"");
}

TEST(SceneOverrides, TheFirstPictureOfASceneWithoutOneCanBeAdded) {
    const Scene scene =
        read(k_drop, {{"picture[0].field", "gamma_eff"}, {"picture[0].name", "tension"}});
    ASSERT_EQ(scene.pictures.size(), 1U);
    EXPECT_EQ(scene.pictures[0].field, "gamma_eff");
    EXPECT_EQ(scene.pictures[0].name, "tension");
}

TEST(SceneOverrides, TextsWithControlCharactersAreRefused) {
    EXPECT_NE(
        refusal(k_drop, {{"scene.title", "\"a\\u001b[2J\""}}).find("(with control characters)"),
        std::string::npos);
}

TEST(SceneOverrides, PathsThatLeadNowhereAreRefused) {
    EXPECT_EQ(refusal(k_drop, {{"stage[1].duration", "2"}}),
              "--set stage[1].duration=2: error: there is no stage[1]: the scene has 1 of them, "
              "counted from 0");
    EXPECT_EQ(refusal(k_drop, {{"picture[1].field", "a"}}),
              "--set picture[1].field=a: error: there is no picture[1]: the scene has 0 of them");
    EXPECT_EQ(refusal(k_drop, {{"cells.radius.min", "5"}}),
              "--set cells.radius.min=5: error: cells.radius is a value in the scene, not a table");
    for (const char* path : {"", "cells.", ".nodes", "stage[x].cap", "stage[0", "stage[-1].cap"})
        EXPECT_EQ(refusal(k_drop, {{path, "1"}}),
                  std::string("--set ") + path + "=1: error: '" + path +
                      "' is not a key\n"
                      "  hint: a key looks like cells.nodes or stage[2].cap");
}

}  // namespace
}  // namespace spheroscope::scene
