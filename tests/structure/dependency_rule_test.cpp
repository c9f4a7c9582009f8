#include "tests/structure/include_rules.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>

namespace spheroscope::structure {
namespace {

namespace fs = std::filesystem;

struct SourceFile {
    std::string path;  ///< relative to the root of the sources
    std::string text;
};

std::vector<SourceFile> read_sources() {
    std::vector<SourceFile> sources;
    for (const char* top : {"engine", "render", "viewer"}) {
        const fs::path folder = fs::path(SPHEROSCOPE_SOURCE_DIR) / top;
        if (!fs::is_directory(folder)) continue;
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
            const std::string extension = entry.path().extension();
            if (extension != ".cpp" && extension != ".hpp") continue;
            std::ifstream file(entry.path());
            sources.push_back({fs::relative(entry.path(), SPHEROSCOPE_SOURCE_DIR).string(),
                               {std::istreambuf_iterator<char>(file), {}}});
        }
    }
    return sources;
}

/// Information, not a rule: a long header is a smell that a person looks into.
void print_header_lengths(const std::vector<SourceFile>& sources) {
    std::vector<std::ptrdiff_t> lengths;
    for (const SourceFile& source : sources) {
        if (fs::path(source.path).extension() != ".hpp") continue;
        lengths.push_back(std::count(source.text.begin(), source.text.end(), '\n'));
        if (lengths.back() > 220)
            std::cout << "long header: " << source.path << ", " << lengths.back() << " lines\n";
    }
    std::sort(lengths.begin(), lengths.end());
    if (!lengths.empty())
        std::cout << "headers: " << lengths.size()
                  << ", median length: " << lengths[lengths.size() / 2] << " lines\n";
}

TEST(DependencyRule, HoldsInAllSources) {
    const std::vector<SourceFile> sources = read_sources();
    ASSERT_GT(sources.size(), 10U) << "the sources were not found";
    for (const SourceFile& source : sources)
        for (const Violation& violation : find_violations(source.path, source.text))
            ADD_FAILURE() << violation;
    print_header_lengths(sources);
}

using Violations = std::vector<Violation>;

TEST(DependencyRule, AnIncludeAgainstTheArrowsIsFoundWithItsLine) {
    EXPECT_EQ(find_violations("engine/forces/a.hpp", "#pragma once\n"
                                                     "#include \"engine/base/vec3.hpp\"\n"
                                                     "#include \"engine/solve/method.hpp\"\n"),
              Violations{"engine/forces/a.hpp:3: engine/forces may not include engine/solve "
                         "(engine/solve/method.hpp)"});
}

TEST(DependencyRule, SidewaysIncludesAreFound) {
    EXPECT_EQ(find_violations("engine/model/a.cpp", "#include \"engine/scene/scene.hpp\"\n").size(),
              1U);
    EXPECT_EQ(find_violations("engine/forces/a.cpp", "#include \"engine/friction/b.hpp\"").size(),
              1U);
}

TEST(DependencyRule, IncludesAlongTheArrowsAndOfTheOwnFolderAreAllowed) {
    EXPECT_EQ(find_violations("engine/solve/a.cpp", "#include \"engine/solve/a.hpp\"\n"
                                                    "#include \"engine/forces/b.hpp\"\n"
                                                    "#include \"engine/base/vec3.hpp\"\n"),
              Violations{});
}

TEST(DependencyRule, TheEngineIncludesNothingThatDraws) {
    for (const char* header : {"vtkRenderer.h", "GL/gl.h", "GL/osmesa.h", "imgui.h", "GLFW/glfw3.h",
                               "render/picture.hpp", "viewer/app.hpp"}) {
        const std::string line = std::string("  #  include <") + header + ">  // why\n";
        EXPECT_EQ(find_violations("engine/run/a.cpp", line).size(), 1U) << header;
    }
}

TEST(DependencyRule, OnlyTheProgramsMainFileMeetsTheVerbsOfRender) {
    const std::string text = "#include \"render/verbs.hpp\"\n";
    EXPECT_EQ(find_violations("engine/cli/main.cpp", text), Violations{});
    EXPECT_EQ(find_violations("engine/cli/program.cpp", text).size(), 1U);
}

TEST(DependencyRule, HeadersOfTheComputingPartsNeedNoFileLibraries) {
    for (const char* header : {"hdf5.h", "H5Cpp.h", "toml++/toml.h", "toml.hpp"}) {
        const std::string line = std::string("#include <") + header + ">\n";
        EXPECT_EQ(find_violations("engine/measures/a.hpp", line).size(), 1U) << header;
        EXPECT_EQ(find_violations("engine/store/a.hpp", line), Violations{}) << header;
    }
}

TEST(DependencyRule, PicturesDoNotSeeHowTheEngineComputes) {
    for (const char* folder : {"solve", "forces", "friction", "contact", "stages"}) {
        const std::string line = std::string("#include \"engine/") + folder + "/a.hpp\"\n";
        EXPECT_EQ(find_violations("render/layers/a.cpp", line).size(), 1U) << folder;
    }
    EXPECT_EQ(find_violations("render/a.cpp", "#include \"engine/run/snapshot.hpp\"\n"
                                              "#include <vtkRenderer.h>\n"),
              Violations{});
}

TEST(DependencyRule, ThePanelSeesPicturesAndItsModelDoesNot) {
    const std::string picture = "#include \"render/picture.hpp\"\n";
    EXPECT_EQ(find_violations("viewer/app.cpp", picture + "#include <imgui.h>\n"), Violations{});
    EXPECT_EQ(find_violations("viewer/model/a.cpp", picture).size(), 1U);
    EXPECT_EQ(find_violations("viewer/model/a.cpp", "#include <imgui.h>\n").size(), 1U);
    EXPECT_EQ(find_violations("viewer/model/a.cpp", "#include \"viewer/app.hpp\"\n").size(), 1U);
    EXPECT_EQ(find_violations("render/a.cpp", "#include \"viewer/model/view.hpp\"\n").size(), 1U);
    EXPECT_EQ(find_violations("viewer/app.cpp", "#include \"engine/solve/method.hpp\"\n").size(),
              1U);
}

TEST(DependencyRule, AFolderWithoutARowIsReported) {
    EXPECT_EQ(find_violations("engine/magic/a.hpp", ""),
              Violations{"engine/magic/a.hpp: the dependency rule has no row for engine/magic"});
}

}  // namespace
}  // namespace spheroscope::structure
