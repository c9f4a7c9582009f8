// Plots by VTK's charts on the OSMesa context, with axes of our own (render/plot_axes).

#include "render/plot.hpp"

#include "engine/base/error.hpp"
#include "render/colour_maps.hpp"
#include "render/line_chart.hpp"
#include "render/osmesa_context.hpp"
#include "render/plot_axes.hpp"
#include "render/png.hpp"
#include "render/text.hpp"

#include <vtkAxis.h>
#include <vtkBrush.h>
#include <vtkChartLegend.h>
#include <vtkChartXY.h>
#include <vtkContext2D.h>
#include <vtkContextActor.h>
#include <vtkContextItem.h>
#include <vtkContextScene.h>
#include <vtkDoubleArray.h>
#include <vtkGL2PSExporter.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPen.h>
#include <vtkPlotLine.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkTable.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <system_error>

namespace spheroscope::render {
namespace {

constexpr int k_panel_width_px = 520, k_panel_height_px = 400;
constexpr int k_title_px = 50;
constexpr int k_legend_row_px = 24, k_caption_row_px = 18;
constexpr int k_title_size = 20, k_panel_title_size = 18, k_legend_size = 14;
constexpr double k_side_px = 20.0;                               // free on both sides of a picture
constexpr double k_swatch_px = 30.0, k_between_names_px = 26.0;  // in the legend above the panels
constexpr int k_colour_bar_px = 110;                             // beside a map

constexpr std::array<int, 5> k_markers{vtkPlotPoints::CIRCLE, vtkPlotPoints::SQUARE,
                                       vtkPlotPoints::DIAMOND, vtkPlotPoints::CROSS,
                                       vtkPlotPoints::PLUS};

/// Paints in the pixels of the scene (origin at the bottom left), before or after a chart.
class Overlay : public vtkContextItem {
  public:
    static Overlay* New();
    bool Paint(vtkContext2D* painter) override {
        if (paint) paint(*painter);
        return true;
    }
    std::function<void(vtkContext2D&)> paint;
};
vtkStandardNewMacro(Overlay);

void use_brush(vtkContext2D& painter, Rgb colour) {
    painter.GetPen()->SetLineType(vtkPen::NO_PEN);
    painter.GetBrush()->SetColor(colour.r, colour.g, colour.b, 255);
}
void use_pen(vtkContext2D& painter, Rgb colour, float width) {
    painter.GetPen()->SetLineType(vtkPen::SOLID_LINE);
    painter.GetPen()->SetColor(colour.r, colour.g, colour.b, 255);
    painter.GetPen()->SetWidth(width);
}
void write(vtkContext2D& painter, double x, double y, const std::string& text, int size, Rgb colour,
           bool is_centred) {
    vtkNew<vtkTextProperty> style;
    set_font(style, size);
    style->SetColor(colour.r / 255.0, colour.g / 255.0, colour.b / 255.0);
    if (is_centred)
        style->SetJustificationToCentered();
    else
        style->SetJustificationToLeft();
    style->SetVerticalJustificationToCentered();
    painter.ApplyTextProp(style);
    painter.DrawString(static_cast<float>(x), static_cast<float>(y), text);
}
void fill(vtkContext2D& painter, double x0, double y0, double x1, double y1) {
    painter.DrawRect(static_cast<float>(x0), static_cast<float>(y0), static_cast<float>(x1 - x0),
                     static_cast<float>(y1 - y0));
}

constexpr Rgb k_dark{38, 40, 44}, k_band{255, 236, 200}, k_band_ink{150, 95, 0};

/// Where the values of a panel are in the scene. A chart knows after it was drawn once.
struct PlotArea {
    vtkChartXY* chart;
    AxisRange x_range, y_range;

    [[nodiscard]] double x(double value) const {
        return along(x_range, value, chart->GetPoint1()[0], chart->GetPoint2()[0]);
    }
    [[nodiscard]] double y(double value) const {
        return along(y_range, value, chart->GetPoint1()[1], chart->GetPoint2()[1]);
    }
    [[nodiscard]] double left() const { return chart->GetPoint1()[0]; }
    [[nodiscard]] double right() const { return chart->GetPoint2()[0]; }
    [[nodiscard]] double top() const { return chart->GetPoint2()[1]; }
    [[nodiscard]] double bottom() const { return chart->GetPoint1()[1]; }

  private:
    /// Ends of the axis for what is beyond them.
    static double along(const AxisRange& range, double value, int low_px, int high_px) {
        const bool is_below = range.is_logarithmic && value <= 0.0;
        const double share =
            is_below ? 0.0 : (range.place(value) - range.low) / (range.high - range.low);
        return low_px + std::clamp(share, 0.0, 1.0) * (high_px - low_px);
    }
};

void paint_bands(vtkContext2D& painter, const PlotArea& area,
                 const std::vector<reports::Plot::Band>& bands) {
    for (const reports::Plot::Band& band : bands) {
        use_brush(painter, band.low == band.high ? k_band_ink : k_band);
        const double low = area.y(band.low), high = area.y(band.high);
        fill(painter, area.left(), low - (band.low == band.high ? 0.75 : 0.0), area.right(),
             high + (band.low == band.high ? 0.75 : 0.0));
    }
}

void paint_band_names(vtkContext2D& painter, const PlotArea& area,
                      const std::vector<reports::Plot::Band>& bands) {
    for (const reports::Plot::Band& band : bands) {
        const double above = area.y(band.high) + 10.0;
        write(painter, area.left() + 8.0,
              above + 8.0 < area.top() ? above : area.y(band.low) - 10.0, band.name, 12, k_band_ink,
              false);
    }
}

void paint_error_bars(vtkContext2D& painter, const PlotArea& area,
                      const reports::Plot::Series& series, Rgb colour) {
    use_pen(painter, colour, 1.4F);
    for (std::size_t i = 0; i < series.error.size(); ++i) {
        if (!std::isfinite(series.error[i])) continue;
        const auto x = static_cast<float>(area.x(series.x[i]));
        const auto low = static_cast<float>(area.y(series.y[i] - series.error[i]));
        const auto high = static_cast<float>(area.y(series.y[i] + series.error[i]));
        painter.DrawLine(x, low, x, high);
        painter.DrawLine(x - 4.0F, low, x + 4.0F, low);
        painter.DrawLine(x - 4.0F, high, x + 4.0F, high);
    }
}

Rgb colour_of(const reports::Plot::Map& map, double value) {
    const ColourMap& colours = map.is_signed ? ColourMap::diverging() : ColourMap::sequential();
    const double share = (value - map.low) / (map.high - map.low);
    if (share < -1e-9) return colours.below();
    if (share > 1.0 + 1e-9) return colours.above();
    return colours.at(std::clamp(share, 0.0, 1.0));
}

void paint_map(vtkContext2D& painter, const PlotArea& area, const reports::Plot::Map& map) {
    const std::size_t n = map.x_labels.size();
    for (std::size_t i = 0; i < map.values.size(); ++i) {
        const auto column = static_cast<double>(i % n), row = static_cast<double>(i / n);
        const double x0 = area.x(column - 0.5), x1 = area.x(column + 0.5);
        const double y0 = area.y(row - 0.5), y1 = area.y(row + 0.5);
        const bool is_missing = std::isnan(map.values[i].value);
        const Rgb colour = is_missing ? Rgb{236, 237, 239} : colour_of(map, map.values[i].value);
        use_brush(painter, colour);
        fill(painter, x0 + 1.0, y0 + 1.0, x1 - 1.0, y1 - 1.0);
        const Rgb ink = to_oklab(colour).lightness > 0.62 ? k_dark : Rgb{255, 255, 255};
        const double middle = 0.5 * (y0 + y1);
        write(painter, 0.5 * (x0 + x1), is_missing ? middle : middle + 7.0,
              is_missing ? "missing" : map.values[i].text, 12,
              is_missing ? Rgb{120, 124, 130} : ink, true);
        if (!map.values[i].mark.empty())
            write(painter, 0.5 * (x0 + x1), middle - 9.0, map.values[i].mark, 11,
                  is_missing ? Rgb{120, 124, 130} : ink, true);
    }
}

void paint_colour_bar(vtkContext2D& painter, const PlotArea& area, const reports::Plot::Map& map) {
    const double x0 = area.right() + 18.0, x1 = x0 + 16.0;
    const double y0 = area.bottom(), y1 = area.top();
    constexpr int n = 64;
    for (int i = 0; i < n; ++i) {
        use_brush(painter, colour_of(map, map.low + (map.high - map.low) * (i + 0.5) / n));
        fill(painter, x0, y0 + (y1 - y0) * i / n, x1, y0 + (y1 - y0) * (i + 1) / n + 0.5);
    }
    const double step = tick_step(map.high - map.low, 5);
    for (double i = std::ceil(map.low / step - 1e-9); i * step <= map.high + 1e-9 * step; ++i)
        write(painter, x1 + 6.0, y0 + (y1 - y0) * (i * step - map.low) / (map.high - map.low),
              tick_label(i * step, step), 13, k_dark, false);
    write(painter, x0 - 4.0, y1 + 16.0, map.title, 13, k_dark, false);
}

/// The colour and marker of a name, the same in all panels.
class Styles {
  public:
    explicit Styles(const reports::Plot& plot) {
        for (const reports::Plot::Panel& panel : plot.panels)
            for (const reports::Plot::Series& series : panel.series)
                if (series.colour_of.empty() &&
                    numbers_.emplace(series.name, numbers_.size()).second)
                    names_.push_back(series.name);
    }
    [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
    [[nodiscard]] Rgb colour(const std::string& name) const {
        return k_distinct_colours[numbers_.at(name) % k_distinct_colours.size()];
    }
    [[nodiscard]] Rgb colour(const reports::Plot::Series& series) const {
        return colour(series.colour_of.empty() ? series.name : series.colour_of);
    }
    void apply(const reports::Plot::Series& series, vtkPlotLine* line) const {
        const Rgb c = colour(series);
        line->SetColor(c.r, c.g, c.b, 255);
        line->SetWidth(2.0F);
        line->GetPen()->SetLineType(series.line == reports::Plot::Line::full ? vtkPen::SOLID_LINE
                                    : series.line == reports::Plot::Line::dashed ? vtkPen::DASH_LINE
                                                                                 : vtkPen::NO_PEN);
        line->SetMarkerStyle(series.has_marks && series.colour_of.empty()
                                 ? k_markers[numbers_.at(series.name) % k_markers.size()]
                                 : static_cast<int>(vtkPlotPoints::NONE));
        line->SetMarkerSize(9.0F);
        line->SetLabel(series.name);
        line->SetLegendVisibility(series.colour_of.empty());
    }

  private:
    std::map<std::string, std::size_t> numbers_;
    std::vector<std::string> names_;
};

PlotArea area_of(const reports::Plot::Panel& panel, vtkChartXY* chart) {
    reports::Plot::Axis x_axis = panel.x_axis, y_axis = panel.y_axis;
    if (panel.map) {
        x_axis.categories = panel.map->x_labels;
        y_axis.categories = panel.map->y_labels;
    }
    PlotArea area{chart, AxisRange(x_axis), AxisRange(y_axis)};
    for (const reports::Plot::Series& series : panel.series)
        for (std::size_t i = 0; i < series.x.size(); ++i) {
            area.x_range.include(series.x[i]);
            area.y_range.include(series.y[i]);
            if (i < series.error.size() && std::isfinite(series.error[i])) {
                area.y_range.include(series.y[i] - series.error[i]);
                area.y_range.include(series.y[i] + series.error[i]);
            }
        }
    for (const reports::Plot::Band& band : panel.bands) {
        area.y_range.include(band.low);
        area.y_range.include(band.high);
    }
    if (x_axis.categories.empty()) area.x_range.widen();
    if (y_axis.categories.empty()) area.y_range.widen();
    set_axis(chart->GetAxis(vtkAxis::BOTTOM), panel.x_title, area.x_range, x_axis.categories);
    set_axis(chart->GetAxis(vtkAxis::LEFT), panel.y_title, area.y_range, y_axis.categories);
    return area;
}

/// Axes of a chart without any line are not drawn; this one is not seen.
void add_unseen_line(vtkChartXY* chart) {
    vtkNew<vtkTable> table;
    for (const char* name : {"x", "y"}) {
        vtkNew<vtkDoubleArray> zeros;
        zeros->SetName(name);
        for (int i = 0; i < 2; ++i) zeros->InsertNextValue(0.0);
        table->AddColumn(zeros);
    }
    auto* const line = vtkPlotLine::SafeDownCast(chart->AddPlot(vtkChart::LINE));
    line->SetInputData(table, 0, 1);
    line->GetPen()->SetLineType(vtkPen::NO_PEN);
    line->SetMarkerStyle(static_cast<int>(vtkPlotPoints::NONE));
    line->SetLegendVisibility(false);
}

void add_lines(const reports::Plot::Panel& panel, const Styles& styles, const PlotArea& area) {
    if (panel.map) add_unseen_line(area.chart);
    for (const reports::Plot::Series& series : panel.series) {
        if (series.x.empty()) continue;
        vtkNew<vtkTable> table;
        vtkNew<vtkDoubleArray> x, y;
        x->SetName("x");
        y->SetName(series.name.c_str());
        for (std::size_t i = 0; i < series.x.size(); ++i) {
            x->InsertNextValue(area.x_range.place(series.x[i]));
            y->InsertNextValue(area.y_range.place(series.y[i]));
        }
        if (series.x.size() == 1) {  // a line wants two
            x->InsertNextValue(x->GetValue(0));
            y->InsertNextValue(y->GetValue(0));
        }
        table->AddColumn(x);
        table->AddColumn(y);
        auto* const line = vtkPlotLine::SafeDownCast(area.chart->AddPlot(vtkChart::LINE));
        line->SetInputData(table, 0, 1);
        styles.apply(series, line);
    }
}

/// As VTK draws it, but before there is a window. VTK hints letters to whole pixels, which is
/// seldom wider than this.
std::string fitting(TextPainter& text, const std::string& words, int size, double width_px,
                    Cut cut = Cut::end, FontStyle font = FontStyle::normal) {
    constexpr double hinting = 0.98;
    return shortened(text, words, {static_cast<double>(size), k_dark, font}, hinting * width_px,
                     cut);
}

/// Adds one panel in its rectangle of the scene (origin at the bottom left, px).
PlotArea add_panel(vtkContextScene* scene, const reports::Plot::Panel& panel, const Styles& styles,
                   vtkRectf place, TextPainter& text) {
    if (panel.map) place.SetWidth(place.GetWidth() - k_colour_bar_px);
    vtkNew<Overlay> below, above;
    vtkNew<vtkChartXY> chart;
    chart->SetAutoSize(false);
    chart->SetSize(place);
    chart->SetTitle(fitting(text, panel.title, k_panel_title_size,
                            static_cast<double>(place.GetWidth()) - k_side_px, Cut::end,
                            FontStyle::bold));
    set_font(chart->GetTitleProperties(), k_panel_title_size, SPHEROSCOPE_FONT_BOLD);
    const PlotArea area = area_of(panel, chart);
    add_lines(panel, styles, area);
    below->paint = [area, &panel](vtkContext2D& painter) {
        paint_bands(painter, area, panel.bands);
    };
    above->paint = [area, &panel, &styles](vtkContext2D& painter) {
        paint_band_names(painter, area, panel.bands);
        for (const reports::Plot::Series& series : panel.series)
            paint_error_bars(painter, area, series, styles.colour(series));
        if (panel.map) {
            paint_map(painter, area, *panel.map);
            paint_colour_bar(painter, area, *panel.map);
        }
    };
    scene->AddItem(below);
    scene->AddItem(chart);
    scene->AddItem(above);
    return area;
}

/// The legend above the panels: the names of all series in as many columns as have room.
struct LegendRows {
    std::vector<std::string> texts;  // as in Styles::names(), none longer than a row
    int n_columns = 1, n_rows = 0;

    LegendRows(const Styles& styles, int width, TextPainter& text) {
        const double row_px = width - 2.0 * k_side_px;
        double widest_px = 0.0;
        for (const std::string& name : styles.names()) {
            texts.push_back(fitting(text, name, k_legend_size, row_px - k_swatch_px, Cut::middle));
            widest_px =
                std::max(widest_px, k_swatch_px + text.width(texts.back(), {k_legend_size}));
        }
        n_columns = std::max(
            1, static_cast<int>((row_px + k_between_names_px) / (widest_px + k_between_names_px)));
        n_rows = (static_cast<int>(texts.size()) + n_columns - 1) / n_columns;
    }

    /// From y downward.
    void paint(vtkContext2D& painter, const Styles& styles, int width, double y) const {
        const double column_px = (width - 2.0 * k_side_px) / n_columns;
        for (std::size_t i = 0; i < texts.size(); ++i) {
            const auto column = static_cast<int>(i) % n_columns,
                       row = static_cast<int>(i) / n_columns;
            const double x = k_side_px + column * column_px;
            const double middle = y - (row + 0.5) * k_legend_row_px;
            use_brush(painter, styles.colour(styles.names()[i]));
            fill(painter, x, middle - 5.0, x + 22.0, middle + 5.0);
            write(painter, x + k_swatch_px, middle, texts[i], k_legend_size, k_dark, false);
        }
    }
};

/// Where the legend stands inside a panel.
struct LegendPlace {
    vtkChartXY* chart = nullptr;
    int horizontal = vtkChartLegend::RIGHT, vertical = vtkChartLegend::TOP;
};

/// How much a legend of that size hides in a panel: points count, and lines between them a little.
double hidden_by(const LegendPlace& place, const reports::Plot::Panel& panel, const PlotArea& area,
                 double width, double height) {
    constexpr double marker_px = 6.0;
    constexpr int n_samples = 16;  // of a line between two points
    const auto begin = [](int alignment, double low, double high, double size) {
        if (alignment == vtkChartLegend::CENTER) return 0.5 * (low + high - size);
        const bool is_high = alignment == vtkChartLegend::RIGHT || alignment == vtkChartLegend::TOP;
        return is_high ? high - size : low;
    };
    const double x0 = begin(place.horizontal, area.left(), area.right(), width);
    const double y0 = begin(place.vertical, area.bottom(), area.top(), height);
    const auto hides = [&](double x, double y) {
        return x > x0 - marker_px && x < x0 + width + marker_px && y > y0 - marker_px &&
               y < y0 + height + marker_px;
    };
    double hidden = 0.0;
    for (const reports::Plot::Series& series : panel.series)
        for (std::size_t i = 0; i < series.x.size(); ++i) {
            const double x = area.x(series.x[i]), y = area.y(series.y[i]);
            if (hides(x, y)) hidden += 1.0;
            if (i == 0 || series.line == reports::Plot::Line::none) continue;
            const double last_x = area.x(series.x[i - 1]), last_y = area.y(series.y[i - 1]);
            for (int k = 1; k < n_samples; ++k)
                if (hides(std::lerp(last_x, x, k / static_cast<double>(n_samples)),
                          std::lerp(last_y, y, k / static_cast<double>(n_samples))))
                    hidden += 0.25 / n_samples;
        }
    return hidden;
}

/// The place that hides least, preferably in the upper right corner of the first panel. A panel
/// shows the names of its own series only, so that one that lacks some comes last.
LegendPlace free_place(const reports::Plot& plot, const std::vector<PlotArea>& areas,
                       const Styles& styles, TextPainter& text) {
    double width = 0.0;  // of VTK's legend: a symbol, and 5 px around everything
    for (const std::string& name : styles.names())
        width = std::max(width, text.width(name, {k_legend_size}) + 44.0);
    const double height = 21.0 * static_cast<double>(styles.names().size()) + 6.0;
    LegendPlace best;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t p = 0; p < areas.size(); ++p) {
        const auto is_missing = [&](const std::string& name) {
            return std::none_of(plot.panels[p].series.begin(), plot.panels[p].series.end(),
                                [&](const reports::Plot::Series& series) {
                                    return series.name == name && !series.x.empty();
                                });
        };
        const double missing =
            1000.0 * static_cast<double>(
                         std::count_if(styles.names().begin(), styles.names().end(), is_missing));
        for (const int vertical :
             {vtkChartLegend::TOP, vtkChartLegend::BOTTOM, vtkChartLegend::CENTER})
            for (const int horizontal :
                 {vtkChartLegend::RIGHT, vtkChartLegend::LEFT, vtkChartLegend::CENTER}) {
                const LegendPlace place{areas[p].chart, horizontal, vertical};
                const double hidden =
                    missing + hidden_by(place, plot.panels[p], areas[p], width, height);
                if (hidden >= least) continue;
                least = hidden;
                best = place;
            }
    }
    return best;
}

void show_legend(const LegendPlace& place) {
    place.chart->SetShowLegend(true);
    vtkChartLegend* const legend = place.chart->GetLegend();
    set_font(legend->GetLabelProperties(), k_legend_size);
    legend->SetHorizontalAlignment(place.horizontal);
    legend->SetVerticalAlignment(place.vertical);
}

void write_svg(vtkRenderWindow* window, vtkRenderer* renderer, const std::filesystem::path& path) {
    const std::filesystem::path unfinished = path.string() + ".part";
    vtkNew<vtkGL2PSExporter> exporter;
    exporter->SetRenderWindow(window);
    exporter->SetActiveRenderer(renderer);
    exporter->SetFileFormatToSVG();
    exporter->CompressOff();
    exporter->SetSortToSimple();
    exporter->TextAsPathOff();
    exporter->SetFilePrefix(unfinished.c_str());
    exporter->UsePainterSettings();
    exporter->SetSilent(1);  // it cannot embed the background as an image; white needs none
    exporter->Write();
    // the exporter appends its own ending to the prefix
    std::error_code failed;
    std::filesystem::rename(unfinished.string() + ".svg", path, failed);
    if (failed)
        throw Error(path.string() + ": the plot could not be written (" + failed.message() + ")",
                    "is the disk full, or the folder protected?", ExitCode::environment);
}

Image image_of(const Buffers& buffers) {
    Image image(buffers.width, buffers.height);
    for (int y = 0; y < buffers.height; ++y) {
        const std::uint8_t* in =
            buffers.rgba.data() + std::ptrdiff_t{4} * buffers.width * (buffers.height - 1 - y);
        for (int x = 0; x < buffers.width; ++x, in += 4) image.set(x, y, {in[0], in[1], in[2]});
    }
    return image;
}

}  // namespace

void draw_plot(const reports::Plot& plot, const std::filesystem::path& png,
               const std::filesystem::path& svg, const PngTexts& texts) {
    const int n_panels = static_cast<int>(plot.panels.size());
    if (n_panels == 0) throw Error("a plot wants at least one panel, got none");
    const int n_columns = std::min(n_panels, plot.columns);
    const int n_rows = (n_panels + n_columns - 1) / n_columns;
    const Styles styles(plot);
    const int width = n_columns * k_panel_width_px;
    TextPainter text;
    const LegendRows legend(styles, width, text);
    const int legend_px = plot.legend_above ? legend.n_rows * k_legend_row_px : 0;
    const int caption_px =
        plot.caption.empty() ? 0 : static_cast<int>(plot.caption.size()) * k_caption_row_px + 14;
    const int height = n_rows * k_panel_height_px + k_title_px + legend_px + caption_px;

    OsmesaContext context(width, height);
    Buffers buffers;
    context.lend([&](vtkRenderWindow* window, vtkRenderer* renderer) {
        vtkNew<vtkContextActor> actor;
        actor->GetScene()->SetRenderer(renderer);
        std::vector<PlotArea> areas;
        for (int p = 0; p < n_panels; ++p) {
            const vtkRectf place(
                static_cast<float>((p % n_columns) * k_panel_width_px),
                static_cast<float>(caption_px + (n_rows - 1 - p / n_columns) * k_panel_height_px),
                static_cast<float>(k_panel_width_px - 12),
                static_cast<float>(k_panel_height_px - 14));
            areas.push_back(add_panel(actor->GetScene(), plot.panels[static_cast<std::size_t>(p)],
                                      styles, place, text));
        }
        vtkNew<Overlay> around;
        around->paint = [&](vtkContext2D& painter) {
            if (plot.legend_above) legend.paint(painter, styles, width, height - k_title_px);
            for (std::size_t i = 0; i < plot.caption.size(); ++i)
                write(painter, k_side_px,
                      caption_px - (static_cast<double>(i) + 0.5) * k_caption_row_px,
                      plot.caption[i], 12, {90, 94, 102}, false);
        };
        actor->GetScene()->AddItem(around);
        vtkNew<vtkTextActor> title;
        title->SetInput(fitting(text, plot.title, k_title_size, width - 2.0 * k_side_px, Cut::end,
                                FontStyle::bold)
                            .c_str());
        title->SetPosition(0.5 * width, height - 0.5 * k_title_px);
        set_font(title->GetTextProperty(), k_title_size, SPHEROSCOPE_FONT_BOLD);
        title->GetTextProperty()->SetJustificationToCentered();
        title->GetTextProperty()->SetVerticalJustificationToCentered();
        renderer->AddActor(actor);
        renderer->AddActor2D(title);
        window->Render();  // charts lay out their axes while they are drawn
        // Colours mean the same in all panels: one legend, where there is room.
        if (!plot.legend_above) show_legend(free_place(plot, areas, styles, text));
        window->Render();
        context.read_colours(buffers);
        write_svg(window, renderer, svg);
        renderer->RemoveActor(actor);
        renderer->RemoveActor2D(title);
        title->ReleaseGraphicsResources(window);
        actor->ReleaseGraphicsResources(window);
    });
    write_png(png, image_of(buffers), texts);
}

}  // namespace spheroscope::render
