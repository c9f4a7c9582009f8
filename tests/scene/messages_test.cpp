#include "engine/scene/value_reader.hpp"
#include "tests/scene/scene_text.hpp"

#include <gtest/gtest.h>

namespace spheroscope::scene {
namespace {

TEST(SceneMessages, AWrongDimensionNamesBothAndQuotesTheLine) {
    const std::string text = with(k_doublet, "E = \"20 kPa\"", "  E = \"20 nN/um\"");
    EXPECT_EQ(refusal(text),
              "a.toml:6:7: error: cortex.elastic.E wants a stiffness (kPa), got \"20 nN/um\" "
              "(a tension)\n"
              "    6 |   E = \"20 nN/um\"\n"
              "      |       ^~~~~~~~~~   typical: 0.3125 ... 320 kPa (Cuvelier et al. 2021, "
              "Table 2)");
}

TEST(SceneMessages, TheCaretStandsUnderTheValueBehindLettersOfTwoBytes) {
    const std::string text = with(k_doublet, "[cells]\n", "[scene]\ntitle = \"µ\"\n[cells]\n");
    const std::string message = refusal(with(text, "radius = \"9 um\"", "radius = \"9 µN\" # µ"));
    EXPECT_EQ(message, "a.toml:5:10: error: cells.radius wants a length (um), got \"9 µN\" "
                       "(a force)\n"
                       "    5 | radius = \"9 µN\" # µ\n"
                       "      |          ^~~~~~   typical: 5 ... 13 um (Cuvelier et al. 2021, "
                       "Table 2)");
}

TEST(SceneMessages, AnUnknownKeyIsMetWithTheNearestOne) {
    EXPECT_EQ(refusal(with(k_doublet, "omega =", "omgea =")),
              "a.toml:23:1: error: unknown key 'omgea' in [contact.adhesion]; did you mean "
              "'omega'?");
    EXPECT_EQ(refusal(with(k_doublet, "[cytosol]", "[cytosol]\nsomething = 1")),
              "a.toml:17:1: error: unknown key 'something' in [cytosol]");
    EXPECT_EQ(refusal(with(k_doublet, "kind =", "knid =")),
              "a.toml:26:1: error: unknown key 'knid' in [stage]; did you mean 'kind'?");
}

TEST(SceneMessages, ALastStageOnACoarserMeshThanTheCellsIsRefused) {
    const std::string last = refusal(with(k_doublet, "kind =", "nodes = 42\nkind ="));
    EXPECT_NE(last.find("the last stage has 42 nodes per cell"), std::string::npos) << last;
}

TEST(SceneMessages, AKeyInTheWrongTableIsSentHome) {
    EXPECT_EQ(refusal(with(k_doublet, "[cytosol]", "[cytosol]\ngap = 1")),
              "a.toml:17:1: error: unknown key 'gap' in [cytosol]; it belongs in [cells]");
    EXPECT_EQ(refusal("title = \"x\"\n" + k_drop),
              "a.toml:1:1: error: unknown key 'title' outside of any table; it belongs in [scene]");
}

TEST(SceneMessages, AnUnknownTableIsMetWithTheNearestOne) {
    EXPECT_EQ(refusal(with(k_doublet, "[contact.adhesion]", "[contact.adhesoin]")),
              "a.toml:22:1: error: unknown table [contact.adhesoin]; did you mean "
              "[contact.adhesion]?");
    EXPECT_EQ(refusal(with(k_drop, "[medium]", "[meduim]")),
              "a.toml:8:1: error: unknown table [meduim]; did you mean [medium]?");
    EXPECT_EQ(refusal(k_drop + "[zzzzzzzz]\n"), "a.toml:13:1: error: unknown table [zzzzzzzz]");
    EXPECT_EQ(refusal(k_drop + "[[pictrue]]\n"),
              "a.toml:13:3: error: unknown table [[pictrue]]; did you mean [[picture]]?");
}

TEST(SceneMessages, AKeyOrTableGivenTwiceIsRefusedAtTheSecond) {
    EXPECT_EQ(refusal(with(k_doublet, "E = \"20 kPa\"", "E = 20\nE = 21")),
              "a.toml:7:5: error: key 'E' is given twice");
    EXPECT_EQ(refusal(k_drop + "[cells]\n"), "a.toml:13:1: error: table [cells] is given twice");
}

TEST(SceneMessages, SyntaxErrorsCarryTheirPlace) {
    EXPECT_EQ(refusal(with(k_drop, "\"9 um\"", "9 um")),
              "a.toml:3:12: error: not valid TOML: Error while parsing key-value pair: expected a "
              "comment or whitespace, saw 'u'");
    EXPECT_EQ(refusal("[cells\n").substr(0, 36), "a.toml:1:7: error: not valid TOML: E");
}

TEST(SceneMessages, ValuesOutOfRangeAreRefusedWithTheRange) {
    EXPECT_EQ(refusal(with(k_doublet, "20 kPa", "-3 kPa")),
              "a.toml:6:5: error: cortex.elastic.E must be > 0, got \"-3 kPa\"\n"
              "    6 | E = \"-3 kPa\"\n"
              "      |     ^~~~~~~~   typical: 0.3125 ... 320 kPa (Cuvelier et al. 2021, Table 2)");
    EXPECT_EQ(refusal(with(k_drop, "[cortex", "nodes = 163\n[cortex")),
              "a.toml:5:9: error: cells.nodes must be 42, 162, 642 or 2562, got 163\n"
              "    5 | nodes = 163\n"
              "      |         ^~~   typical: 162 (quick), 642 (chosen here)");
    EXPECT_EQ(refusal(k_drop + "[[picture]]\nsize = [1280, 721]\n"),
              "a.toml:14:15: error: picture[0].size must be even numbers in 64 ... 4096, as movies "
              "need them, got 721\n"
              "   14 | size = [1280, 721]\n"
              "      |               ^~~   typical: [1280, 720]");
}

TEST(SceneMessages, ZeroCellsAreRefused) {
    const std::string text =
        with(k_drop, "\"single\"\nradius = \"9 um\"", "\"packing\"\ncount = 0");
    EXPECT_EQ(refusal(text),
              "a.toml:3:9: error: cells.count must be 1 ... 100000, got 0\n"
              "    3 | count = 0\n"
              "      |         ^   typical: 75 ... 600 (Cuvelier et al. 2021, section "
              "2)");
}

TEST(SceneMessages, NumbersThatAreNotFiniteAreRefused) {
    EXPECT_EQ(refusal(with(k_doublet, "\"20 kPa\"", "inf")),
              "a.toml:6:5: error: cortex.elastic.E wants a stiffness (kPa), got inf (not finite)\n"
              "    6 | E = inf\n"
              "      |     ^~~   typical: 0.3125 ... 320 kPa (Cuvelier et al. 2021, Table 2)");
    EXPECT_EQ(
        refusal(with(k_doublet, "\"20 kPa\"", "nan")).substr(0, 82),
        "a.toml:6:5: error: cortex.elastic.E wants a stiffness (kPa), got nan (not finite)\n");
}

TEST(SceneMessages, SizesThatNoQuantityOfTheirKindHasAreRefused) {
    EXPECT_EQ(refusal(with(k_doublet, "\"9 um\"", "1e200")),
              "a.toml:3:10: error: cells.radius must be 1e-06 ... 1e+06 um, got 1e200\n"
              "    3 | radius = 1e200\n"
              "      |          ^~~~~   typical: 5 ... 13 um (Cuvelier et al. 2021, Table 2)");
    const auto expect_begin = [](const std::string& text, const std::string& begin) {
        EXPECT_TRUE(refusal(text).starts_with("a.toml:" + begin)) << refusal(text);
    };
    expect_begin(with(k_doublet, "\"9 um\"", "\"1e-7 um\""),
                 "3:10: error: cells.radius must be 1e-06 ... 1e+06 um, got \"1e-7 um\"\n");
    expect_begin(with(k_doublet, "\"20 kPa\"", "\"1e5 GPa\""),
                 "6:5: error: cortex.elastic.E must be 1e-12 ... 1e+09 kPa, got \"1e5 GPa\"\n");
    expect_begin(with(k_drop, "\"1 s\"", "1e30"),
                 "12:12: error: stage[0].duration must be 1e-15 ... 1e+09 s, got 1e30\n");
    expect_begin(k_drop + "[load.body_force]\nforce = [0, 0, -1e10]\n",
                 "14:16: error: load.body_force.force must be -1e+09 ... 1e+09 nN, got -1e10\n");
    const std::string by_override = refusal(k_drop, {{"cells.radius", "1e200"}});
    EXPECT_TRUE(by_override.starts_with(
        "--set cells.radius=1e200: error: cells.radius must be 1e-06 ... 1e+06 um, got 1e+200"))
        << by_override;
    // No key is without: what may be zero may also be next to it.
    for (const Key& key : all_keys()) {
        EXPECT_NE(missed_sizes(key, 1e200), "") << key.table << "." << key.name;
        const bool can_be_zero = key.bound.holds == nullptr || key.bound.holds(0.0);
        EXPECT_EQ(missed_sizes(key, 1e-200).empty(), can_be_zero) << key.table << "." << key.name;
    }
}

TEST(SceneMessages, AValueThatFollowsFromOthersMustBeOneThatAFileMaySay) {
    const std::string text = with(k_doublet, "E = \"20 kPa\"", "Et_over_omega = 1e11");
    EXPECT_EQ(refusal(text),
              "a.toml:5:1: error: cortex.elastic.E must be 1e-12 ... 1e+09 kPa, got 2.5e+11 kPa "
              "from other keys\n  hint: it follows from E, Et_over_omega");
}

TEST(SceneMessages, ValuesOfAnotherTypeAreRefused) {
    EXPECT_EQ(refusal(with(k_drop, "[cortex", "nodes = 162.5\n[cortex")).substr(0, 64),
              "a.toml:5:9: error: cells.nodes wants an integer, got 162.5\n    5");
    EXPECT_EQ(
        refusal(with(k_doublet, "E = \"20 kPa\"", "E = { a = 1 }")),
        "a.toml:6:5: error: cortex.elastic.E wants a stiffness (kPa), got a table\n"
        "    6 | E = { a = 1 }\n"
        "      |     ^~~~~~~~~   typical: 0.3125 ... 320 kPa (Cuvelier et al. 2021, Table 2)");
    EXPECT_EQ(refusal(with(k_drop, "[medium]", "[measures]\nfields = [\"a\", 3]\n[medium]")),
              "a.toml:9:16: error: measures.fields wants a list of texts, got 3\n"
              "    9 | fields = [\"a\", 3]\n"
              "      |                ^");
    EXPECT_EQ(refusal(k_drop + "[load.body_force]\nforce = [1, 2]\n"),
              "a.toml:14:9: error: load.body_force.force wants a list of three: force (nN), got "
              "[1, 2] (2 of them)\n"
              "   14 | force = [1, 2]\n"
              "      |         ^~~~~~   typical: 1 nN (chosen here)");
}

TEST(SceneMessages, TablesThatAreValuesAndListsThatAreTablesAreRefused) {
    EXPECT_EQ(refusal("medium = 5\n" + with(k_drop, "[medium]", "")),
              "a.toml:1:10: error: [medium] is a table, got 5\n"
              "    1 | medium = 5\n"
              "      |          ^");
    EXPECT_EQ(refusal(with(k_drop, "[[stage]]", "[stage]")),
              "a.toml:10:1: error: stage is a list of tables, each with a header [[stage]], got a "
              "table\n"
              "   10 | [stage]\n"
              "      | ^~~~~~~");
}

TEST(SceneMessages, ATableThatOnlyHoldsTablesIsNoValue) {
    const std::string holds = "error: [load] holds tables only: [load.body_force]";
    EXPECT_EQ(refusal("load = 5\n" + k_drop), "a.toml:1:1: " + holds);
    EXPECT_EQ(refusal("[[load]]\n" + k_drop), "a.toml:1:3: " + holds);
}

TEST(SceneMessages, AWrongWordIsMetWithTheNearestOne) {
    EXPECT_EQ(
        refusal(with(k_drop, "\"single\"", "\"singel\"")),
        "a.toml:2:15: error: cells.arrangement wants one of \"packing\", \"single\", \"pair\", "
        "\"centres\", \"file\", got \"singel\"\n"
        "    2 | arrangement = \"singel\"\n"
        "      |               ^~~~~~~~   did you mean \"single\"?");
}

TEST(SceneMessages, ANumberInPlaceOfAWordIsMetWithTheWords) {
    EXPECT_EQ(
        refusal(with(k_drop, "\"single\"", "[1, 2]")),
        "a.toml:2:15: error: cells.arrangement wants one of \"packing\", \"single\", \"pair\", "
        "\"centres\", \"file\", got [1, 2]\n"
        "    2 | arrangement = [1, 2]\n"
        "      |               ^~~~~~");
}

TEST(SceneMessages, MissingKeysAndTablesAreNamed) {
    EXPECT_EQ(refusal(with(k_drop, "gamma = \"0.5 nN/um\"", "")),
              "a.toml:5:1: error: cortex.tension.gamma is missing; it is required\n"
              "  hint: typical: 0.5 nN/um");
    EXPECT_EQ(refusal(with(k_drop, "radius = \"9 um\"", "")),
              "a.toml:1:1: error: cells.radius is missing; it is required with arrangement = "
              "\"packing\", \"single\" or \"pair\"\n  hint: typical: 5 ... 13 um");
    EXPECT_EQ(refusal("[medium]\n"), "a.toml: error: the table [cells] is missing");
    EXPECT_EQ(refusal(""), "a.toml: error: the table [cells] is missing");
}

TEST(SceneMessages, KeysThatDoNotApplyAreRefused) {
    EXPECT_EQ(refusal(with(k_doublet, "[cortex.elastic]", "count = 2\n[cortex.elastic]")),
              "a.toml:5:1: error: cells.count does not apply here: it belongs with arrangement = "
              "\"packing\"");
    EXPECT_EQ(refusal(with(k_drop, "[cortex", "gap = 1\n[cortex")),
              "a.toml:5:1: error: cells.gap does not apply here: it belongs with arrangement = "
              "\"pair\"");
    EXPECT_EQ(
        refusal(with(k_doublet, "[cytosol]", "[cytosol]\nT_I = 1\ncontroller = \"proportional\"")),
        "a.toml:17:1: error: cytosol.T_I does not apply here: it belongs with controller = "
        "\"pid\"");
    EXPECT_EQ(refusal(k_drop + "steps = 5\n"),
              "a.toml:13:1: error: stage[0].steps does not apply here: it belongs in a stage of "
              "kind \"anneal\"");
    EXPECT_EQ(refusal(k_drop + "cap = 5\n"),
              "a.toml:13:1: error: stage[0].cap does not apply here: it belongs with until = "
              "\"rest\" or \"stationary\"");
    EXPECT_EQ(refusal(k_drop + "until = \"rest\"\n"),
              "a.toml:12:1: error: stage[0].duration does not apply here: it belongs in a stage of "
              "given length, so not in \"anneal\" nor with until = \"rest\" or \"stationary\"");
    EXPECT_EQ(refusal(k_drop + "[method]\ndisplacement_bound = 1\n"),
              "a.toml:14:1: error: method.displacement_bound does not apply here: it belongs with "
              "[contact]");
}

TEST(SceneMessages, ExclusiveKeysAreCounted) {
    EXPECT_EQ(refusal(with(k_doublet, "omega = \"0.5 nN/um\"", "omega = 0.5\nW = 0.5")),
              "a.toml:24:1: error: [contact.adhesion] wants exactly one of omega, "
              "gamma_over_omega, W, got omega and W");
    EXPECT_EQ(refusal(with(k_doublet, "omega = \"0.5 nN/um\"", "")),
              "a.toml:22:1: error: [contact.adhesion] wants exactly one of omega, "
              "gamma_over_omega, W, got none of them");
}

TEST(SceneMessages, FilesThatCannotBeReadAreNamed) {
    const auto refusal_of_file = [](const std::string& path) -> std::string {
        try {
            static_cast<void>(load_scene(path));
        } catch (const Error& error) {
            return error.what();
        }
        return "accepted";
    };
    EXPECT_EQ(refusal_of_file("/nowhere/a.toml"),
              "/nowhere/a.toml: error: cannot open the scene: No such file or directory");
    EXPECT_EQ(refusal_of_file("/tmp"),
              "/tmp: error: this is a directory, wanted a scene file (*.toml)");
}

TEST(Messages, OfShotsNameTheShotAndSayWhatThereIs) {
    const auto with_shots = [](const std::string& shots) {
        return refusal(k_drop + "[[picture]]\nshots = " + shots + "\n");
    };
    const std::string at = "a.toml:13:1: error: picture.shots";
    EXPECT_TRUE(with_shots("[\"jump\"]").starts_with(at + ": \"jump\": no such shot"));
    EXPECT_TRUE(
        with_shots("[\"play to 2 um\"]")
            .starts_with(at + ": \"play to 2 um\": wanted is a time, got \"2 um\" (a length)"))
        << with_shots("[\"play to 2 um\"]");
    EXPECT_TRUE(with_shots("[\"freeze 2 s, orbit 3 s\"]").find("wanted is an angle") !=
                std::string::npos);
    EXPECT_TRUE(with_shots("[\"freeze 0 s\"]").find("at most 10 min") != std::string::npos);
    EXPECT_TRUE(with_shots("[\"play to 2 s\", \"play to 1 s\"]").find("already") !=
                std::string::npos);
    EXPECT_TRUE(with_shots("[\"freeze 2 s\"]").starts_with(at + " plays nothing"));
}

}  // namespace
}  // namespace spheroscope::scene
