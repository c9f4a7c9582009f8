// Letters over something drawn have a white edge; elsewhere they look as without one.

#include "render/text.hpp"

#include <gtest/gtest.h>

#include <algorithm>

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

}  // namespace
}  // namespace spheroscope::render
