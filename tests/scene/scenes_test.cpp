#include "engine/scene/keys.hpp"
#include "tests/scene/scene_text.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

namespace spheroscope::scene {
namespace {

const std::filesystem::path k_scenes = std::filesystem::path(SPHEROSCOPE_SOURCE_DIR) / "scenes";

std::vector<std::string> all_scene_files() {
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(k_scenes))
        if (entry.path().extension() == ".toml") files.push_back(entry.path().string());
    return files;
}

std::string text_of(const std::filesystem::path& path) {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
}

TEST(SceneFiles, AllOfThemLoadWithoutAWarning) {
    ASSERT_GE(all_scene_files().size(), 11U);
    for (const std::string& file : all_scene_files()) {
        Scene scene;
        EXPECT_NO_THROW(scene = load_scene(file));
        EXPECT_TRUE(scene.warnings.empty()) << file;
        EXPECT_FALSE(scene.title.empty()) << file;
    }
}

TEST(SceneFiles, TheCanonicalTextIsItsOwnCanonicalText) {
    for (const std::string& file : all_scene_files()) {
        const Scene scene = load_scene(file);
        const Scene again = parse_scene(scene.resolved_toml, file);
        EXPECT_EQ(again.resolved_toml, scene.resolved_toml) << file;
    }
}

TEST(SceneFiles, TheCanonicalTextKeepsEveryKindOfValue) {
    const std::string text = R"([scene]
title = "quotes \" and \\ and µ and \u00e9"
seed = 9223372036854775807
[cells]
arrangement = "centres"
nodes = 42
centres = [[0.1, 0.2, 0.30000000000000004, 9], [18, 0, 0, 9]]
[cortex]
thickness = "123.4 nm"
[cortex.tension]
gamma = 0.7
[medium]
[contact]
[contact.adhesion]
W = 0.3333333333333333
equilibrium_overlap = 1
[load.body_force]
force = [1e-3, "2 pN", -3]
opposed = true
[[stage]]
kind = "relax"
until = "stationary"
[[picture]]
range = "given"
given_range = [-0.1, 0.3]
azimuth = "12.3 deg"
[expect]
"odd name.x" = { value = 0.1, relative = 0.3 }
)";
    const Scene a = parse_scene(text, "a.toml");
    const Scene b = parse_scene(a.resolved_toml, "b.toml");
    EXPECT_EQ(b.resolved_toml, a.resolved_toml);
    EXPECT_EQ(b.title, "quotes \" and \\ and µ and é");
    EXPECT_EQ(b.seed, 9223372036854775807U);
    EXPECT_EQ(b.cells.centres_um, a.cells.centres_um);
    EXPECT_EQ(b.cells.centres_um[0][2], 0.30000000000000004);
    EXPECT_EQ(b.cells.count, 2);
    EXPECT_EQ(b.cortex.thickness_um, 0.1234);
    EXPECT_EQ(b.contact->W_nN_per_um, 0.3333333333333333);
    EXPECT_EQ(b.contact->equilibrium_overlap_h0, 1.0);
    EXPECT_EQ(b.contact->omega_reading, OmegaReading::work_of_adhesion);
    EXPECT_EQ(b.body_force->force_nN, (std::array<double, 3>{1e-3, 2e-3, -3.0}));
    EXPECT_EQ(b.stages[0].until, Until::stationary);
    EXPECT_EQ(b.stages[0].cap_s, 120.0);
    EXPECT_EQ(b.pictures[0].given_range, (std::array<double, 2>{-0.1, 0.3}));
    EXPECT_EQ(b.pictures[0].azimuth_deg, 12.3);
    EXPECT_EQ(b.expect[0].measure, "odd name.x");
    EXPECT_EQ(b.expect[0].min, a.expect[0].min);
    EXPECT_EQ(b.expect[0].max, a.expect[0].max);
}

TEST(SceneFiles, ThePaperCasesHaveThePapersValues) {
    struct Row {
        const char* file;
        double E, omega;
        bool guarded;
    };
    for (const Row& row :
         {Row{"case_a.toml", 20.0, 0.5, false}, Row{"case_b.toml", 5.0, 0.125, false},
          Row{"case_c.toml", 0.3125, 0.5, true}}) {
        const Scene scene = load_scene((k_scenes / "paper" / row.file).string());
        EXPECT_EQ(scene.cortex.elastic->E_kPa, row.E);
        EXPECT_EQ(scene.contact->omega_nN_per_um, row.omega);
        EXPECT_EQ(scene.contact->W_nN_per_um, row.omega);
        EXPECT_EQ(scene.cortex.regularisation.has_value(), row.guarded);
        EXPECT_EQ(scene.cells.count, 150);
        EXPECT_EQ(scene.cells.nodes, 642);
        EXPECT_EQ(scene.cells.radius.shape, 37.75);
    }
}

TEST(SceneKeys, EveryKeyIsDocumentedInTheFolderOfTheScenes) {
    const std::string readme = text_of(k_scenes / "README.md");
    const std::string begin = "<!-- keys: begin -->\n", end = "<!-- keys: end -->";
    const auto from = readme.find(begin);
    const auto to = readme.find(end);
    ASSERT_NE(from, std::string::npos);
    ASSERT_NE(to, std::string::npos);
    const std::string documented = readme.substr(from + begin.size(), to - from - begin.size());
    const std::string wanted = keys_markdown();
    if (documented != wanted) {
        const std::string path = std::string(SPHEROSCOPE_BINARY_DIR) + "/scene_keys.md";
        std::ofstream(path) << wanted;
        ADD_FAILURE() << "scenes/README.md differs from the table of keys; put " << path
                      << " between its markers";
    }
}

TEST(SceneKeys, EveryKeyBelongsToATableAndNoneIsListedTwice) {
    std::set<std::string> tables, paths;
    for (const Table& table : all_tables())
        EXPECT_TRUE(tables.insert(std::string(table.path)).second) << table.path;
    for (const Key& key : all_keys()) {
        EXPECT_TRUE(tables.count(std::string(key.table)) == 1) << key.table;
        const std::string path = std::string(key.table) + "." + std::string(key.name);
        EXPECT_TRUE(paths.insert(path).second) << path;
        EXPECT_FALSE(key.description.empty()) << path;
    }
}

}  // namespace
}  // namespace spheroscope::scene
