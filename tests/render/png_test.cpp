#include "engine/base/error.hpp"
#include "render/png.hpp"
#include "tests/render/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <fstream>

namespace spheroscope::render {
namespace {

Image gradient() {
    Image image(33, 17);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            image.set(x, y,
                      {static_cast<std::uint8_t>(7 * x), static_cast<std::uint8_t>(15 * y),
                       static_cast<std::uint8_t>(x * y)});
    return image;
}

TEST(Png, GivesBackPixelsAndTextsAsTheyWere) {
    const TemporaryFolder folder;
    const auto path = folder.path() / "a.png";
    const PngTexts texts{{"Title", "Spheroid, σ_nn in µm²"},
                         {"Scene", std::string(5000, 'x') + "\nend"},
                         {"Empty", ""}};
    write_png(path, gradient(), texts);
    const PngFile file = read_png(path);
    EXPECT_TRUE(file.image == gradient());
    EXPECT_EQ(file.texts, texts);
    EXPECT_EQ(read_png_texts(path), texts);
    EXPECT_FALSE(std::filesystem::exists(path.string() + ".partial"));
}

TEST(Png, RefusesACutFileADamagedFileAndAForeignFile) {
    const TemporaryFolder folder;
    const auto path = folder.path() / "a.png";
    write_png(path, gradient());
    std::ifstream in(path, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(in)), {});
    const auto refuses = [&](const std::string& content) {
        const auto bad = folder.path() / "bad.png";
        std::ofstream(bad, std::ios::binary) << content;
        try {
            static_cast<void>(read_png(bad));
            return false;
        } catch (const Error& error) {
            return std::string(error.what()).find("bad.png") != std::string::npos;
        }
    };
    EXPECT_FALSE(refuses(bytes)) << "the whole file is read";
    EXPECT_TRUE(refuses(bytes.substr(0, bytes.size() / 2)));
    EXPECT_TRUE(refuses(bytes.substr(0, bytes.size() - 20)));
    std::string flipped = bytes;
    flipped[bytes.size() / 2] = static_cast<char>(flipped[bytes.size() / 2] ^ 0x55);
    EXPECT_TRUE(refuses(flipped));
    EXPECT_TRUE(refuses("not a picture"));
    EXPECT_TRUE(refuses(""));
}

TEST(Png, OfSixteenBitsIsRefusedAsHalfOfThemWouldBeLost) {
    const TemporaryFolder folder;
    const auto path = folder.path() / "deep.png";
    // one grey pixel, 0x1234
    const unsigned char bytes[] = {0x89, 'P',  'N',  'G',  '\r', '\n', 0x1a, '\n', 0,    0,    0,
                                   13,   'I',  'H',  'D',  'R',  0,    0,    0,    1,    0,    0,
                                   0,    1,    16,   0,    0,    0,    0,    0x6a, 0xee, 0x47, 0x16,
                                   0,    0,    0,    0x0b, 'I',  'D',  'A',  'T',  0x78, 0x9c, 0x63,
                                   0x10, 0x32, 0x01, 0,    0,    0x5c, 0,    0x47};
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes), sizeof(bytes));
    try {
        static_cast<void>(read_png(path));
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("8 bits a channel is wanted, got 16"),
                  std::string::npos)
            << error.what();
    }
}

TEST(Png, ThatCannotBeWrittenIsAnErrorAndLeavesNothing) {
    const TemporaryFolder folder;
    EXPECT_THROW(write_png(folder.path() / "missing" / "a.png", gradient()), Error);
    const auto taken = folder.path() / "taken.png";
    std::filesystem::create_directories(taken / "by a folder");
    EXPECT_THROW(write_png(taken, gradient()), Error);
    EXPECT_FALSE(std::filesystem::exists(taken.string() + ".partial"));
    // A full disk: /dev/full takes the open, not the bytes.
    const auto path = folder.path() / "full.png";
    std::filesystem::create_symlink("/dev/full", path.string() + ".partial");
    try {
        write_png(path, gradient());
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::environment);
        EXPECT_NE(std::string(error.what()).find("No space left"), std::string::npos)
            << error.what();
        EXPECT_NE(std::string(error.what()).find("is the disk full"), std::string::npos);
    }
    EXPECT_FALSE(std::filesystem::exists(path));
    EXPECT_FALSE(std::filesystem::is_symlink(path.string() + ".partial"));
}

}  // namespace
}  // namespace spheroscope::render
