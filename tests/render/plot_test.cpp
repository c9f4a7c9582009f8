#include "engine/base/error.hpp"
#include "render/plot.hpp"
#include "render/png.hpp"
#include "tests/render/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>

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

TEST(Plot, WithoutAPanelIsRefused) {
    EXPECT_THROW(draw_plot({}, "/nowhere/a.png", "/nowhere/a.svg"), Error);
}

}  // namespace
}  // namespace spheroscope::render
