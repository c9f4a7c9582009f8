#include "render/osmesa_context.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>

namespace spheroscope::render {
namespace {

TEST(Osmesa, StandsBeforeEveryOtherLibraryThatHasOpenGl) {
    const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
    const std::unique_ptr<FILE, int (*)(FILE*)> output(
        popen(("readelf --wide --dynamic '" + program + "'").c_str(), "r"), pclose);
    ASSERT_TRUE(output);
    std::array<char, 512> line;
    std::string needed;
    while (std::fgets(line.data(), static_cast<int>(line.size()), output.get()) != nullptr)
        if (std::string(line.data()).find("(NEEDED)") != std::string::npos) needed += line.data();
    const std::size_t osmesa = needed.find("libOSMesa");
    ASSERT_NE(osmesa, std::string::npos) << needed;
    ASSERT_NE(needed.find("libvtkRenderingOpenGL2"), std::string::npos) << needed;
    for (const char* other : {"libvtk", "libGL", "libOpenGL", "libGLEW", "libEGL"})
        EXPECT_LT(osmesa, needed.find(other)) << needed;
}

TEST(Osmesa, PassesItsProbeOnAThreadOfItsOwnBesideAnother) {
    const OsmesaContext here(64, 48);
    std::string failure;
    std::thread([&failure] {
        try {
            const OsmesaContext there(48, 64);
        } catch (const std::exception& error) {
            failure = error.what();
        }
    }).join();
    EXPECT_EQ(failure, "");
}

}  // namespace
}  // namespace spheroscope::render
