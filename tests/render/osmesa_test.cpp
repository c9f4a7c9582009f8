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

TEST(Osmesa, IsTheFirstLibraryThatTheProgramNeeds) {
    const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
    const std::unique_ptr<FILE, int (*)(FILE*)> output(
        popen(("readelf --wide --dynamic '" + program + "'").c_str(), "r"), pclose);
    ASSERT_TRUE(output);
    std::array<char, 512> line;
    std::string first;
    while (std::fgets(line.data(), static_cast<int>(line.size()), output.get()) != nullptr)
        if (first.empty() && std::string(line.data()).find("(NEEDED)") != std::string::npos)
            first = line.data();
    EXPECT_NE(first.find("libOSMesa"), std::string::npos) << "first needed: " << first;
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
