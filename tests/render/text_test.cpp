// Letters over something drawn have a white edge, elsewhere they look as without one; what is too
// long is shortened.

#include "render/text.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace spheroscope::render {
namespace {

Image written_on(Rgb background, double halo_px) {
    Image image(120, 40, background);
    TextPainter text;
    TextPainter::Style style;
    style.halo_px = halo_px;
    text.draw(image, 10.0, 28.0, "15 nN", style);
    return image;
}

std::size_t count(const Image& image, Rgb colour) {
    std::size_t n = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) n += image.at(x, y) == colour ? 1 : 0;
    return n;
}

TEST(TextHalo, IsWhiteAroundTheLettersAndLeavesThemAsTheyAre) {
    const Rgb blue{60, 90, 160}, white{255, 255, 255};
    const Image plain = written_on(blue, 0.0), edged = written_on(blue, 2.5);
    EXPECT_EQ(count(plain, white), 0U);
    EXPECT_GT(count(edged, white), 100U);
    const Rgb ink = TextPainter::Style().colour;
    EXPECT_GT(10 * count(edged, ink), 9 * count(plain, ink));  // but for their blended edges
    EXPECT_EQ(edged.at(0, 0), blue);  // away from the letters nothing changes
    EXPECT_EQ(edged.at(119, 39), blue);
}

TEST(TextHalo, OnWhiteIsNotThere) {
    EXPECT_EQ(written_on({255, 255, 255}, 0.0), written_on({255, 255, 255}, 2.5));
}

TEST(Text, ThatIsTooLongIsCutWhereItIsWanted) {
    TextPainter text;
    const TextPainter::Style style;
    const std::string words = "γ/ω = 1, Under the bead: 15 nN, seed 1";
    const double all = text.width(words, style);
    EXPECT_EQ(shortened(text, words, style, all), words);
    const std::string front = shortened(text, words, style, 0.6 * all);
    EXPECT_LE(text.width(front, style), 0.6 * all);
    EXPECT_EQ(front.rfind("γ/ω = 1, U", 0), 0U) << front;
    EXPECT_EQ(front.substr(front.size() - 3), "…");
    const std::string both = shortened(text, words, style, 0.6 * all, Cut::middle);
    EXPECT_LE(text.width(both, style), 0.6 * all);
    EXPECT_EQ(both.rfind("γ/ω = 1", 0), 0U) << both;
    EXPECT_EQ(both.substr(both.size() - 6), "seed 1") << both;
    EXPECT_EQ(shortened(text, words, style, 10.0), "") << "two letters have no room";
    const std::string greek = "γγγγγγγγ";
    const std::string whole = shortened(text, greek, style, 0.8 * text.width(greek, style));
    ASSERT_GT(whole.size(), 3U);
    EXPECT_EQ(whole.size() % 2, 1U) << whole << ": letters of two bytes and a … of three";
}

}  // namespace
}  // namespace spheroscope::render
