#include "engine/base/error.hpp"
#include "render/colour_maps.hpp"
#include "render/plot.hpp"
#include "render/plot_axes.hpp"
#include "render/png.hpp"
#include "tests/render/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <vtkSmartPointer.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUtilities.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <utility>
#include <vector>

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
    testing::internal::CaptureStderr();
    draw_plot(two_panels(), png, svg);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << "VTK finds nothing wrong with it";
    const Image image = read_png(png).image;
    EXPECT_GT(share_of(image, {255, 255, 255}), 0.8);
    EXPECT_GT(share_of(image, {0, 114, 178}), 5e-4) << "the first series is blue";
    std::ifstream file(svg);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    for (const char* word : {"error (units of h₀)", "γ_eff", "10⁻⁵", "wall time (s)", "</svg>"})
        EXPECT_NE(text.find(word), std::string::npos) << word;
}

TEST(Plot, OfNamesWithTheSignsOfXmlIsADrawingThatXmlCanRead) {
    reports::Plot plot = two_panels();
    plot.title = "a <b> & c";
    plot.caption = {"made of \"A&B\" > 1"};
    plot.panels[0].y_title = "<F> (nN)";
    const TemporaryFolder folder;
    const auto svg = folder.path() / "plot.svg";
    draw_plot(plot, folder.path() / "plot.png", svg);
    const auto root =
        vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromFile(svg.c_str()));
    ASSERT_NE(root, nullptr) << "not XML";
    EXPECT_STREQ(root->GetName(), "svg");
    std::ifstream file(svg);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    for (const char* words : {">a &lt;b&gt; &amp; c<", "A&amp;B", "&lt;F&gt; (nN)"})
        EXPECT_NE(text.find(words), std::string::npos) << words;
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 2);
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

/// Left ends and baselines of the texts of an SVG that begin with these words.
std::vector<std::array<double, 2>> places_of(const std::filesystem::path& svg,
                                             const std::string& words) {
    std::ifstream file(svg);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    std::vector<std::array<double, 2>> places;
    const std::regex entry("<text[^>]* x=\"([-0-9.]+)\" y=\"([-0-9.]+)\"[^>]*>" + words);
    for (std::sregex_iterator i(text.begin(), text.end(), entry), end; i != end; ++i)
        places.push_back({std::stod((*i)[1]), std::stod((*i)[2])});
    return places;
}

TEST(Plot, DrawsWhatIsCrossedOutInTheColourOfItsNameWithoutALineOrAWordInTheLegend) {
    reports::Plot plot;
    plot.title = "Failed";
    reports::Plot::Panel panel{"a", "x", "y"};
    panel.series = {{"one", {1.0, 2.0}, {1.0, 2.0}}};
    plot.panels = {panel};
    const TemporaryFolder folder;
    const auto png = folder.path() / "plot.png", svg = folder.path() / "plot.svg";
    const auto blue = [&] {
        draw_plot(plot, png, svg);
        return share_of(read_png(png).image, {0, 114, 178});
    };
    // A series of this colour without marks or line is there in both, so that the axes are the
    // same.
    reports::Plot::Series crosses{"one, failed", {4.0, 8.0}, {8.0, 8.0}};
    crosses.colour_of = "one";
    crosses.line = reports::Plot::Line::none;
    plot.panels[0].series.push_back(crosses);
    const double without = blue();
    plot.panels[0].series[1].is_crossed_out = true;
    EXPECT_GT(blue(), without);
    EXPECT_TRUE(places_of(svg, "one, failed").empty());
    EXPECT_EQ(places_of(svg, "one").size(), 1U);
}

TEST(Plot, ItsLegendAboveIsAsWideAsItsNames) {
    reports::Plot plot;
    plot.title = "Figure";
    plot.legend_above = true;
    reports::Plot::Panel panel{"a", "x", "y"};
    for (const char* name :
         {"Name one: 15 nN on thirteen cells, stiff hull, and more of them",
          "Name two: 30 nN on thirteen cells, stiff hull, and more of them", "Name three"})
        panel.series.push_back({name, {1, 2}, {1, 2}});
    plot.panels = {panel, panel};
    plot.columns = 2;
    const TemporaryFolder folder;
    const auto png = folder.path() / "plot.png", svg = folder.path() / "plot.svg";
    draw_plot(plot, png, svg);
    auto places = places_of(svg, "Name ");
    ASSERT_EQ(places.size(), 3U) << "each once, and whole";
    std::sort(places.begin(), places.end(), [](auto p, auto q) { return p[1] < q[1]; });
    // Two of these names (about 460 px each) have room in 1000 px.
    EXPECT_EQ(places[0][1], places[1][1]);
    EXPECT_GT(std::abs(places[0][0] - places[1][0]), 460.0);
    EXPECT_GT(places[2][1], places[0][1] + 15.0);

    plot.panels = {panel};
    plot.panels[0].series[0].name += ", so that a picture of one panel is too narrow";
    draw_plot(plot, png, svg);
    const Image image = read_png(png).image;
    EXPECT_EQ(places_of(svg, "Name ").size(), 3U);
    EXPECT_EQ(places_of(svg, "Name [^<]*…[^<]*narrow").size(), 1U) << "cut in its middle";
    int n_ink = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = image.width - 8; x < image.width; ++x) n_ink += image.at(x, y).r < 200 ? 1 : 0;
    EXPECT_EQ(n_ink, 0) << "nothing is cut off at the edge";
}

TEST(Plot, ItsLegendTellsMoreNamesApartThanThereAreColours) {
    reports::Plot plot;
    plot.title = "Figure";
    plot.legend_above = true;
    reports::Plot::Panel panel{"a", "x", "y"};
    constexpr int n_names = 2 * static_cast<int>(k_distinct_colours.size());
    for (int i = 0; i < n_names; ++i) {
        panel.series.push_back({"Name " + std::to_string(i) + ".", {1, 2}, {1, 2}});
        panel.series.back().has_marks = false;
    }
    plot.panels = {panel};
    const TemporaryFolder folder;
    const auto png = folder.path() / "plot.png", svg = folder.path() / "plot.svg";
    draw_plot(plot, png, svg);
    const Image image = read_png(png).image;
    const auto swatch = [&](int i) {  // what stands before the name
        const auto places = places_of(svg, "Name " + std::to_string(i) + "\\.");
        EXPECT_EQ(places.size(), 1U);
        std::vector<int> pixels;
        for (int y = -12; y <= 12; ++y)
            for (int x = -32; x < -4; ++x) {
                const Rgb c = image.at(static_cast<int>(places[0][0]) + x,
                                       static_cast<int>(places[0][1]) + y);
                pixels.push_back((c.r << 16) | (c.g << 8) | c.b);
            }
        return pixels;
    };
    std::vector<std::vector<int>> all;
    for (int i = 0; i < n_names; ++i) all.push_back(swatch(i));
    std::sort(all.begin(), all.end());
    EXPECT_EQ(std::adjacent_find(all.begin(), all.end()), all.end());
}

TEST(Plot, ItsLegendStandsWhereItHidesNoPoint) {
    // Points all along the upper half, where the legend would be, of a colour of their own.
    reports::Plot plot = two_panels();
    plot.panels.resize(1);
    reports::Plot::Series many{"many", {}, {}};
    many.line = reports::Plot::Line::none;
    for (int i = 0; i <= 20; ++i) {
        many.x.push_back(std::pow(10.0, i / 20.0));
        many.y.push_back(1.0);
    }
    plot.panels[0].series = {{"one", {1.0}, {0.1}}, many};
    const TemporaryFolder folder;
    const auto png = folder.path() / "plot.png", svg = folder.path() / "plot.svg";
    const auto orange = [&] {
        draw_plot(plot, png, svg);
        const Image image = read_png(png).image;
        return share_of(image, {213, 94, 0}) * image.width * image.height;
    };
    const double inside = orange();
    plot.legend_above = true;
    // The legends' own samples: one mark inside, 22 x 10 px above.
    EXPECT_GT(inside, orange() - 220.0) << "all 21 marks are seen";
}

TEST(Plot, ItsLegendInsideKeepsClearOfThePanelsTitle) {
    reports::Plot plot = two_panels();
    plot.panels.resize(1);
    plot.panels[0].title = "gypsy pig";  // letters that reach below their line
    plot.panels[0].series = {{"one", {1, 2, 4}, {0.02, 0.02, 0.02}}};
    plot.panels[0].title += std::string(40, 'g');  // above all corners
    const TemporaryFolder folder;
    const auto png = folder.path() / "plot.png", svg = folder.path() / "plot.svg";
    draw_plot(plot, png, svg);
    const Image image = read_png(png).image;
    // The legend's frame is black, as no other line of that length is but the axes below it.
    int legend_top = 0;
    for (int y = 0, longest = 0; y < image.height && longest < 50; ++y) {
        legend_top = y;
        for (int x = 0, length = 0; x < image.width; ++x) {
            const Rgb p = image.at(x, y);
            length = p.r + p.g + p.b < 30 ? length + 1 : 0;
            longest = std::max(longest, length);
        }
    }
    const auto titles = places_of(svg, "gypsy");
    ASSERT_EQ(titles.size(), 1U);
    constexpr double descent = 0.24 * 18.0;  // of DejaVu Sans in the size of a panel's title
    EXPECT_GT(legend_top, titles[0][1] + descent + 2.0);
    EXPECT_LT(legend_top, 200) << "it is the legend's";
}

TEST(Axis, ThatIsLogarithmicHasTwoLabelsOrMoreHoweverShort) {
    reports::Plot::Axis axis;
    for (const double low : {0.0017, 0.31, 1.0, 1.9, 4.0, 60.0})
        for (const double ratio : {1.0, 1.3, 2.0, 4.0, 8.0, 30.0, 1e6}) {
            AxisRange range(axis);
            range.include(low);
            range.include(low * ratio);
            range.widen();
            const std::vector<AxisTick> ticks = logarithmic_ticks(range);
            EXPECT_GE(ticks.size(), 2U) << low << " to " << low * ratio;
            for (const AxisTick& tick : ticks)
                EXPECT_TRUE(tick.place >= range.low && tick.place <= range.high) << tick.label;
        }
    AxisRange range(axis);
    range.include(0.0015);
    range.include(0.006);
    range.widen();
    std::vector<std::string> labels;
    for (const AxisTick& tick : logarithmic_ticks(range)) labels.push_back(tick.label);
    EXPECT_EQ(labels, (std::vector<std::string>{"2·10⁻³", "5·10⁻³"}));
}

AxisRange range_of(double low, double high) {
    reports::Plot::Axis axis;
    axis.is_logarithmic = false;
    AxisRange range(axis);
    range.include(low);
    range.include(high);
    range.widen();
    return range;
}

TEST(Axis, ThatIsBrokenIsToScaleForPointsAndKeepsTheOrder) {
    struct Case {
        double begin, end;  // of what is far away
    };
    for (const Case far :
         {Case{-358.0, -358.0}, Case{-400.0, -300.0}, Case{900.0, 900.0}, Case{500.0, 900.0}}) {
        SCOPED_TRACE(far.begin);
        const AxisRange whole = range_of(-20.0, 5.0);
        AxisRange range = whole;
        range.break_off(far.begin, far.end);
        EXPECT_EQ(range.high - range.low, 1.25 * (whole.high - whole.low));
        for (const double value : {-20.0, -3.0, 0.0, 5.0}) EXPECT_EQ(range.place(value), value);
        const double between = 0.5 * (far.begin + (far.begin < 0.0 ? whole.low : whole.high));
        std::vector<double> values{far.begin, far.end, between, whole.low, 0.0, whole.high};
        std::sort(values.begin(), values.end());
        for (std::size_t i = 0; i < values.size(); ++i) {
            const double place = range.place(values[i]);
            EXPECT_TRUE(place >= range.low && place <= range.high) << values[i];
            if (i > 0) {
                EXPECT_GE(place, range.place(values[i - 1])) << values[i];
            }
        }
        const double gap = range.broken->gap;
        EXPECT_TRUE(gap < whole.low || gap > whole.high);
        EXPECT_EQ(range.place(far.begin) < gap, far.begin < 0.0) << "the sign is between them";
    }
}

/// Rows of the picture in which the first colour is, from the first to the last.
int rows_of_first_colour(const reports::Plot& plot, const TemporaryFolder& folder) {
    draw_plot(plot, folder.path() / "plot.png", folder.path() / "plot.svg");
    const Image image = read_png(folder.path() / "plot.png").image;
    int first = image.height, last = 0;
    for (int y = 90; y < image.height; ++y)  // below title and legend
        for (int x = 0; x < image.width; ++x)
            if (image.at(x, y) == Rgb{0, 114, 178}) {
                first = std::min(first, y);
                last = std::max(last, y);
            }
    return last - first;
}

TEST(Plot, BreaksItsAxisWhereABandIsFarFromAllPoints) {
    reports::Plot plot;
    plot.title = "Stress";
    reports::Plot::Panel panel{"a  mean normal stress", "r / R_th", "stress (Pa)"};
    panel.x_axis.is_logarithmic = panel.y_axis.is_logarithmic = false;
    panel.series = {{"one", {0.25, 0.5, 0.75}, {-20.0, 4.0, -8.0}, {2.0, 2.0, 2.0}}};
    panel.bands = {{-358.0, -358.0, "experiment"}};
    plot.panels = {panel};
    plot.legend_above = true;
    const TemporaryFolder folder;
    const int flat = rows_of_first_colour(plot, folder);
    plot.panels[0].y_axis.breaks_before_bands = true;
    const int spread = rows_of_first_colour(plot, folder);
    EXPECT_LT(flat, 60) << "of 320 rows";
    EXPECT_GT(spread, 180);
    std::ifstream file(folder.path() / "plot.svg");
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    for (const char* word : {">−358<", ">−20<", ">0<", "experiment"})
        EXPECT_NE(text.find(word), std::string::npos) << word;
    EXPECT_EQ(text.find(">−300<"), std::string::npos);

    // zero stays on the axis where all points are on one side of it
    plot.panels[0].series[0].y = {-20.0, -12.0, -16.0};
    draw_plot(plot, folder.path() / "plot.png", folder.path() / "plot.svg");
    std::ifstream negative(folder.path() / "plot.svg");
    EXPECT_NE(std::string(std::istreambuf_iterator<char>(negative), {}).find(">0<"),
              std::string::npos);

    // a band near the points is to scale
    plot.panels[0].bands[0] = {-40.0, -40.0, "experiment"};
    const int near = rows_of_first_colour(plot, folder);
    plot.panels[0].y_axis.breaks_before_bands = false;
    EXPECT_EQ(near, rows_of_first_colour(plot, folder));
}

TEST(Plot, WithoutAPanelIsRefused) {
    EXPECT_THROW(draw_plot({}, "/nowhere/a.png", "/nowhere/a.svg"), Error);
}

TEST(Plot, OfValuesThatDifferInTheirLastDigitsEnds) {
    const TemporaryFolder folder;
    const auto png = folder.path() / "plot.png", svg = folder.path() / "plot.svg";
    for (const double value : {6.461538461538462, -6.461538461538462, 3e15}) {
        reports::Plot plot = two_panels();
        plot.panels.resize(1);
        plot.panels[0].x_axis.is_logarithmic = plot.panels[0].y_axis.is_logarithmic = false;
        plot.panels[0].series[0].y = {value, std::nextafter(value, 1e16), value};
        draw_plot(plot, png, svg);
        EXPECT_GT(share_of(read_png(png).image, {0, 114, 178}), 5e-4) << value;
    }
}

}  // namespace
}  // namespace spheroscope::render
