#include "engine/base/error.hpp"
#include "render/colour_maps.hpp"
#include "render/plot.hpp"
#include "render/png.hpp"
#include "tests/render/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <utility>

namespace spheroscope::render {
namespace {

reports::Plot two_panels() {
    reports::Plot plot;
    plot.title = "Error against run time";
    plot.panels.push_back({"Positions",
                           "wall time (s)",
                           "error (units of h₀)",
                           {{"one", {1, 2, 4}, {0.1, 0.05, 0.02}}}});
    plot.panels.push_back({"γ_eff", "wall time (s)", "error (relative)", {{"one", {3}, {1e-5}}}});
    return plot;
}

/// Share of pixels of a colour, within a few steps of 255.
double share_of(const Image& image, Rgb colour) {
    std::size_t n = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const Rgb p = image.at(x, y);
            if (std::abs(p.r - colour.r) + std::abs(p.g - colour.g) + std::abs(p.b - colour.b) < 12)
                ++n;
        }
    return static_cast<double>(n) / (image.width * image.height);
}

TEST(Plot, HasItsLinesInThePictureAndItsWordsInTheDrawing) {
    const TemporaryFolder folder;
    const auto png = folder.path() / "plot.png", svg = folder.path() / "plot.svg";
    draw_plot(two_panels(), png, svg);
    const Image image = read_png(png).image;
    EXPECT_GT(share_of(image, {255, 255, 255}), 0.8);
    EXPECT_GT(share_of(image, {0, 114, 178}), 5e-4) << "the first series is blue";
    std::ifstream file(svg);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    for (const char* word : {"error (units of h₀)", "γ_eff", "10⁻⁵", "wall time (s)", "</svg>"})
        EXPECT_NE(text.find(word), std::string::npos) << word;
}

TEST(Plot, DrawsErrorBarsBandsAndACaptionOnLinearAxes) {
    reports::Plot plot;
    plot.title = "Profiles";
    reports::Plot::Panel panel{"a  stress", "r / R_th", "σ^h (Pa)"};
    panel.x_axis.is_logarithmic = panel.y_axis.is_logarithmic = false;
    panel.series = {{"one", {0.25, 0.75}, {-20.0, 10.0}, {15.0, 15.0}}};
    plot.panels = {panel};
    plot.legend_above = true;
    plot.caption = {"Made by: spheroscope figures"};
    const TemporaryFolder folder;
    const auto png = folder.path() / "plot.png", svg = folder.path() / "plot.svg";
    const auto blue_and_band = [&] {
        draw_plot(plot, png, svg, {{"Command", "spheroscope figures"}});
        const Image image = read_png(png).image;
        return std::pair{share_of(image, {0, 114, 178}), share_of(image, {255, 236, 200})};
    };
    const auto [with_bars, without_band] = blue_and_band();
    plot.panels[0].series[0].error.clear();
    plot.panels[0].bands = {{-10.0, 0.0, "experiment"}};
    const auto [without_bars, with_band] = blue_and_band();
    EXPECT_GT(with_bars, without_bars + 2e-4);
    EXPECT_EQ(without_band, 0.0);
    EXPECT_GT(with_band, 0.05) << "a third of the panel";
    EXPECT_EQ(read_png_texts(png).at("Command"), "spheroscope figures");
    std::ifstream file(svg);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    for (const char* word : {"σ^h (Pa)", "experiment", "Made by: spheroscope figures", "−20"})
        EXPECT_NE(text.find(word), std::string::npos) << word;
}

TEST(Plot, DrawsAMapInItsColoursWithMissingPointsAsSuch) {
    reports::Plot plot;
    plot.title = "Map";
    reports::Plot::Panel panel{"a  Z", "Et/ω", "γ/ω"};
    panel.map = reports::Plot::Map{
        {"1/8", "8"},
        {"1", "4"},
        {{10.0, "10", ""}, {8.0, "8", "±0.1"}, {9.0, "9", "†"}, {std::nan(""), "", ""}},
        "Z",
        8.0,
        10.0};
    plot.panels = {panel};
    const TemporaryFolder folder;
    const auto png = folder.path() / "map.png", svg = folder.path() / "map.svg";
    draw_plot(plot, png, svg);
    const Image image = read_png(png).image;
    EXPECT_GT(share_of(image, ColourMap::sequential().at(1.0)), 0.05);
    EXPECT_GT(share_of(image, ColourMap::sequential().at(0.0)), 0.05);
    EXPECT_GT(share_of(image, {236, 237, 239}), 0.05) << "no value";
    std::ifstream file(svg);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    for (const char* word : {"missing", "±0.1", "†", "1/8", "γ/ω"})
        EXPECT_NE(text.find(word), std::string::npos) << word;
}

TEST(Plot, WithoutAPanelIsRefused) {
    EXPECT_THROW(draw_plot({}, "/nowhere/a.png", "/nowhere/a.svg"), Error);
}

}  // namespace
}  // namespace spheroscope::render
