// Plots by VTK's charts on the OSMesa context. Logarithms are taken here, and the axes are linear
// with their own labels: VTK's logarithmic axes label a range of less than a decade with nothing,
// and write 1e-3 where a reader expects 10⁻³. Every text gets the font file, because VTK's built-in
// font has neither Greek nor superscripts.

#include "render/plot.hpp"

#include "engine/base/error.hpp"
#include "render/osmesa_context.hpp"
#include "render/png.hpp"

#include <vtkAxis.h>
#include <vtkChartLegend.h>
#include <vtkChartXY.h>
#include <vtkContextActor.h>
#include <vtkContextScene.h>
#include <vtkDoubleArray.h>
#include <vtkGL2PSExporter.h>
#include <vtkNew.h>
#include <vtkPen.h>
#include <vtkPlotLine.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <system_error>

namespace spheroscope::render {
namespace {

constexpr int k_panel_width_px = 520, k_panel_height_px = 400;
constexpr int k_panels_in_a_row = 3;
constexpr int k_title_px = 50;

/// Okabe and Ito 2008: told apart with all kinds of colour vision.
constexpr std::array<Rgb, 7> k_colours{{{0, 114, 178},
                                        {213, 94, 0},
                                        {0, 158, 115},
                                        {204, 121, 167},
                                        {86, 180, 233},
                                        {230, 159, 0},
                                        {60, 60, 60}}};
constexpr std::array<int, 5> k_markers{vtkPlotPoints::CIRCLE, vtkPlotPoints::SQUARE,
                                       vtkPlotPoints::DIAMOND, vtkPlotPoints::CROSS,
                                       vtkPlotPoints::PLUS};

void set_font(vtkTextProperty* text, int size, const char* file = SPHEROSCOPE_FONT) {
    text->SetFontFamily(VTK_FONT_FILE);
    text->SetFontFile(file);
    text->SetFontSize(size);
    text->SetColor(0.15, 0.16, 0.17);
    text->SetBold(0);
    text->SetItalic(0);
}

/// "10⁻³"; between decades "2", "5".
std::string power_of_ten(int exponent) {
    static const std::array<const char*, 10> digits{"⁰", "¹", "²", "³", "⁴",
                                                    "⁵", "⁶", "⁷", "⁸", "⁹"};
    if (exponent == 0) return "1";
    std::string text = "10";
    if (exponent < 0) text += "⁻";
    for (const char c : std::to_string(std::abs(exponent)))
        text += digits[static_cast<std::size_t>(c - '0')];
    return text;
}

/// Ends of an axis, in what is drawn along it: the value or its log10.
struct AxisRange {
    double low = 1.0, high = -1.0;

    void include(const std::vector<double>& values) {
        for (const double value : values) {
            if (low > high) low = high = value;
            low = std::min(low, value);
            high = std::max(high, value);
        }
    }
    /// Some space around the points, but none below zero where all are above it.
    void widen_linear() {
        const double space = high > low ? 0.06 * (high - low) : 1.0;
        low = low >= 0.0 && low < 0.5 * high ? 0.0 : low - space;
        high += space;
    }
    /// At least one whole decade inside, and some space around the points.
    void widen_logarithmic() {
        low -= 0.15;
        high += 0.15;
        if (std::floor(high) < std::ceil(low) + 1.0) {
            const double middle = std::round(0.5 * (low + high));
            low = std::min(low, middle - 0.55);
            high = std::max(high, middle + 0.55);
        }
    }
};

void set_axis(vtkAxis* axis, const std::string& title, const AxisRange& range) {
    axis->SetBehavior(vtkAxis::FIXED);
    axis->SetRange(range.low, range.high);
    axis->SetTitle(title);
    set_font(axis->GetTitleProperties(), 16);
    set_font(axis->GetLabelProperties(), 14);
    axis->SetGridVisible(true);
    axis->GetGridPen()->SetColor(225, 227, 230);
}

void set_decades(vtkAxis* axis, const AxisRange& range) {
    const int first = static_cast<int>(std::ceil(range.low));
    const int last = static_cast<int>(std::floor(range.high));
    const int step = std::max(1, (last - first) / 5);
    vtkNew<vtkDoubleArray> places;
    vtkNew<vtkStringArray> labels;
    for (int exponent = first; exponent <= last; exponent += step) {
        places->InsertNextValue(exponent);
        labels->InsertNextValue(power_of_ten(exponent));
    }
    axis->SetCustomTickPositions(places, labels);
}

/// The colour and marker of a name, the same in all panels.
class Styles {
  public:
    explicit Styles(const reports::Plot& plot) {
        for (const reports::Plot::Panel& panel : plot.panels)
            for (const reports::Plot::Series& series : panel.series)
                numbers_.emplace(series.name, numbers_.size());
    }
    void apply(const std::string& name, vtkPlotLine* line) const {
        const std::size_t number = numbers_.at(name);
        const Rgb colour = k_colours[number % k_colours.size()];
        line->SetColor(colour.r, colour.g, colour.b, 255);
        line->SetWidth(2.0F);
        line->SetMarkerStyle(k_markers[number % k_markers.size()]);
        line->SetMarkerSize(9.0F);
        line->SetLabel(name);
    }

  private:
    std::map<std::string, std::size_t> numbers_;
};

/// One chart in its rectangle of the scene (origin at the bottom left, px).
vtkNew<vtkChartXY> make_chart(const reports::Plot::Panel& panel, const Styles& styles,
                              const vtkRectf& place) {
    vtkNew<vtkChartXY> chart;
    chart->SetAutoSize(false);
    chart->SetSize(place);
    chart->SetTitle(panel.title);
    set_font(chart->GetTitleProperties(), 18, SPHEROSCOPE_FONT_BOLD);
    const bool is_logarithmic = panel.axes == reports::Plot::Axes::logarithmic;
    const auto drawn = [&](std::vector<double> values) {
        if (is_logarithmic)
            for (double& value : values) value = std::log10(value);
        return values;
    };
    AxisRange x_range, y_range;
    for (const reports::Plot::Series& series : panel.series) {
        if (series.x.empty()) continue;
        const std::vector<double> xs = drawn(series.x), ys = drawn(series.y);
        x_range.include(xs);
        y_range.include(ys);
        vtkNew<vtkTable> table;
        vtkNew<vtkDoubleArray> x, y;
        x->SetName("x");
        y->SetName(series.name.c_str());
        for (std::size_t i = 0; i < series.x.size(); ++i) {
            x->InsertNextValue(xs[i]);
            y->InsertNextValue(ys[i]);
        }
        table->AddColumn(x);
        table->AddColumn(y);
        auto* const line = vtkPlotLine::SafeDownCast(chart->AddPlot(vtkChart::LINE));
        line->SetInputData(table, 0, 1);
        styles.apply(series.name, line);
    }
    for (AxisRange* range : {&x_range, &y_range})
        is_logarithmic ? range->widen_logarithmic() : range->widen_linear();
    vtkAxis* const bottom = chart->GetAxis(vtkAxis::BOTTOM);
    vtkAxis* const left = chart->GetAxis(vtkAxis::LEFT);
    set_axis(bottom, panel.x_title, x_range);
    set_axis(left, panel.y_title, y_range);
    if (is_logarithmic) {
        set_decades(bottom, x_range);
        set_decades(left, y_range);
    }
    return chart;
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
               const std::filesystem::path& svg) {
    const int n_panels = static_cast<int>(plot.panels.size());
    if (n_panels == 0) throw Error("a plot wants at least one panel, got none");
    const int n_columns = std::min(n_panels, k_panels_in_a_row);
    const int n_rows = (n_panels + n_columns - 1) / n_columns;
    const int width = n_columns * k_panel_width_px;
    const int height = n_rows * k_panel_height_px + k_title_px;
    const Styles styles(plot);

    OsmesaContext context(width, height);
    Buffers buffers;
    context.lend([&](vtkRenderWindow* window, vtkRenderer* renderer) {
        vtkNew<vtkContextActor> actor;
        actor->GetScene()->SetRenderer(renderer);
        for (int p = 0; p < n_panels; ++p) {
            const vtkRectf place(
                static_cast<float>((p % n_columns) * k_panel_width_px),
                static_cast<float>((n_rows - 1 - p / n_columns) * k_panel_height_px),
                static_cast<float>(k_panel_width_px - 12),
                static_cast<float>(k_panel_height_px - 14));
            actor->GetScene()->AddItem(
                make_chart(plot.panels[static_cast<std::size_t>(p)], styles, place));
        }
        // Colours mean the same in all panels: one legend, in the panel where there is room.
        auto* const first = vtkChartXY::SafeDownCast(actor->GetScene()->GetItem(0));
        first->SetShowLegend(true);
        set_font(first->GetLegend()->GetLabelProperties(), 14);
        first->GetLegend()->SetHorizontalAlignment(vtkChartLegend::RIGHT);
        first->GetLegend()->SetVerticalAlignment(vtkChartLegend::TOP);
        vtkNew<vtkTextActor> title;
        title->SetInput(plot.title.c_str());
        title->SetPosition(0.5 * width, height - 0.5 * k_title_px);
        set_font(title->GetTextProperty(), 20, SPHEROSCOPE_FONT_BOLD);
        title->GetTextProperty()->SetJustificationToCentered();
        title->GetTextProperty()->SetVerticalJustificationToCentered();
        renderer->AddActor(actor);
        renderer->AddActor2D(title);
        window->Render();
        window->Render();  // charts lay out their axes while they are drawn
        context.read_colours(buffers);
        write_svg(window, renderer, svg);
        renderer->RemoveActor(actor);
        renderer->RemoveActor2D(title);
        title->ReleaseGraphicsResources(window);
        actor->ReleaseGraphicsResources(window);
    });
    write_png(png, image_of(buffers));
}

}  // namespace spheroscope::render
