#include "engine/measures/totals.hpp"
#include "render/layers/plot_strip.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string>

namespace spheroscope::render {
namespace {

PlotStrip rising_curves() {
    PlotStrip strip;
    strip.heading = "contact_area (µm²)";
    strip.curves = {{"Under the bead: 15 nN", {0.0, 50.0, 187.5}, {1000.0, 3000.0, 3500.0}},
                    {"Under the bead: 30 nN", {0.0, 50.0, 187.5}, {900.0, 3100.0, 3200.0}}};
    return strip;
}

TEST(PlotStrip, IsUprightBelowPicturesOfEverySize) {
    const PlotStrip strip = rising_curves();
    for (const auto& [width, height] : {std::array{320, 180},
                                        {480, 300},
                                        {640, 360},
                                        {900, 400},
                                        {1280, 720},
                                        {64, 64},
                                        {4096, 64},
                                        {64, 4096},
                                        {200, 120}}) {
        const PlotStripPainter painter(strip, width, height);
        const Image image = painter.draw(std::array{187.5, 187.5});
        ASSERT_EQ(image.height, PlotStripPainter::height_px(height));
        EXPECT_EQ(image.height % 2, 0) << "movies want it";
        const PlotStripPainter::Point low = painter.point(0.0, 1000.0),
                                      high = painter.point(187.5, 3500.0);
        EXPECT_GT(low.y - high.y, 0.3 * image.height) << width << " x " << height;
        EXPECT_GT(high.x - low.x, 0.45 * width) << width << " x " << height;
        EXPECT_GE(high.y, 0.0);
        EXPECT_LE(low.y, image.height);
        EXPECT_GE(low.x, 0.0);
        EXPECT_LE(high.x, width);
    }
}

TEST(PlotStrip, IsAQuarterOfALargePicture) {
    EXPECT_EQ(PlotStripPainter::height_px(720), 180);
    EXPECT_EQ(PlotStripPainter::height_px(2160), 540);
}

TEST(PlotStrip, OfNothingButUndefinedValuesSaysSoAndInventsNoAxis) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    PlotStrip strip = rising_curves();
    const auto ink = [&](double x0, double x1, double y0, double y1) {
        const Image image = PlotStripPainter(strip, 640, 360).draw(std::array{187.5, 187.5});
        int n = 0;
        for (int y = static_cast<int>(y0 * image.height); y < y1 * image.height; ++y)
            for (int x = static_cast<int>(x0 * image.width); x < x1 * image.width; ++x)
                n += image.at(x, y) == Rgb{255, 255, 255} ? 0 : 1;
        return n;
    };
    EXPECT_GT(ink(0.0, 0.07, 0.2, 0.75), 50) << "numbers at the left";
    strip.curves.resize(1);
    strip.curves[0].value = {nan, nan, nan};
    EXPECT_EQ(ink(0.0, 0.07, 0.2, 0.75), 0) << "no numbers";
    EXPECT_EQ(ink(0.12, 0.3, 0.24, 0.75), 0) << "no lines of a grid";
    EXPECT_GT(ink(0.35, 0.75, 0.35, 0.65), 100) << "the words";
}

TEST(PlotStrip, HasTheNumberOfZeroWhereverItIsInBetween) {
    for (const double lowest : {-190.0, -95.0, -30.0, -7.0}) {
        PlotStrip strip;
        strip.heading = "sigma_h_rim (Pa)";
        strip.curves.push_back({"a", {0.0, 1.0, 2.0}, {50.0, lowest, 0.0}});
        const PlotStripPainter painter(strip, 1280, 720);
        const double times[]{0.0};
        const Image image = painter.draw(times);
        const double y = painter.point(0.0, 0.0).y;
        int n_ink = 0;
        for (int row = -10; row <= 10; ++row)
            for (int x = 0; x < painter.point(0.0, 0.0).x - 8; ++x)
                n_ink += image.at(x, static_cast<int>(y) + row) == Rgb{255, 255, 255} ? 0 : 1;
        EXPECT_GT(n_ink, 20) << lowest;
    }
}

TEST(PlotStrip, WritesUnitsAsPicturesDo) {
    EXPECT_EQ(shown_unit("um^2").text, "µm²");
    EXPECT_EQ(shown_unit("kPa").text, "Pa");
    EXPECT_EQ(shown_unit("kPa").per_stored, 1000.0);
    EXPECT_EQ(shown_unit("nN um/s").text, "nN µm/s");
    EXPECT_EQ(shown_unit("1").text, "");
    for (const TotalsRow& row : all_totals()) {
        const std::string text = shown_unit(row.unit).text;
        EXPECT_EQ(text.find('^'), std::string::npos) << row.name;
        EXPECT_EQ(text.find("um"), std::string::npos) << row.name;
        EXPECT_EQ(text.find("kPa"), std::string::npos) << row.name;
    }
}

}  // namespace
}  // namespace spheroscope::render
