// Plots by VTK's charts on the OSMesa context, with axes of our own (render/plot_axes).

#include "render/plot.hpp"

#include "engine/base/error.hpp"
#include "engine/base/whole_file.hpp"
#include "engine/base/xml_text.hpp"
#include "render/osmesa_context.hpp"
#include "render/plot_area.hpp"
#include "render/plot_axes.hpp"
#include "render/plot_ink.hpp"
#include "render/plot_legend.hpp"
#include "render/plot_marks.hpp"
#include "render/png.hpp"
#include "render/text.hpp"

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
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <string_view>
#include <system_error>

namespace spheroscope::render {
namespace {

constexpr int k_panel_width_px = 520, k_panel_height_px = 400;
constexpr int k_title_px = 50, k_caption_row_px = 18;
constexpr int k_title_size = 20, k_panel_title_size = 18;

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

void add_lines(const reports::Plot::Panel& panel, const PlotStyles& styles, const PlotArea& area) {
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

/// Adds one panel in its rectangle of the scene (origin at the bottom left, px).
PlotArea add_panel(vtkContextScene* scene, const reports::Plot::Panel& panel,
                   const PlotStyles& styles, vtkRectf place, TextPainter& text) {
    if (panel.map) place.SetWidth(place.GetWidth() - k_colour_bar_px);
    vtkNew<Overlay> below, above;
    vtkNew<vtkChartXY> chart;
    chart->SetAutoSize(false);
    chart->SetSize(place);
    chart->SetTitle(fitting(text, panel.title, k_panel_title_size,
                            static_cast<double>(place.GetWidth()) - k_plot_side_px, Cut::end,
                            FontStyle::bold));
    set_font(chart->GetTitleProperties(), k_panel_title_size, SPHEROSCOPE_FONT_BOLD);
    const PlotArea area = area_of(panel, chart);
    add_lines(panel, styles, area);
    below->paint = [area, &panel](vtkContext2D& painter) {
        paint_bands(painter, area, panel.bands);
    };
    above->paint = [area, &panel, &styles](vtkContext2D& painter) {
        paint_break(painter, area, panel.bands);
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

/// What the exporter writes between <text ...> and </text>, one to a line, is what it was given, so
/// that "<" and "&" of a name would be read as XML.
std::string with_escaped_texts(std::string_view svg) {
    constexpr std::string_view begin = "<text ", end = "</text>\n";
    std::string result;
    while (true) {
        const std::size_t tag = svg.find(begin), words = svg.find('>', tag);
        const std::size_t after = words == svg.npos ? svg.npos : svg.find(end, words);
        if (tag == svg.npos || after == svg.npos) return result.append(svg);
        result.append(svg.substr(0, words + 1));
        result += escape_xml(svg.substr(words + 1, after - words - 1));
        result.append(end);
        svg.remove_prefix(after + end.size());
    }
}

void write_svg(vtkRenderWindow* window, vtkRenderer* renderer, const std::filesystem::path& path) {
    WholeFile whole(path);
    const std::filesystem::path& unfinished = whole.working_path();
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
    const std::filesystem::path exported = unfinished.string() + ".svg";
    std::ifstream file(exported, std::ios::binary);
    const std::string svg{std::istreambuf_iterator<char>(file), {}};
    file.close();
    std::error_code failed;
    std::filesystem::remove(exported, failed);
    std::ofstream escaped(unfinished, std::ios::binary);
    escaped << with_escaped_texts(svg);
    escaped.close();
    // What the exporter could not write ends without this.
    const bool is_whole = svg.find("</svg>") != svg.npos && !escaped.fail();
    if (is_whole) failed = whole.publish();
    if (!is_whole || failed)
        throw Error(path.string() + ": the plot could not be written" +
                        (failed ? " (" + failed.message() + ")" : ""),
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
    const PlotStyles styles(plot);
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
                write(painter, k_plot_side_px,
                      caption_px - (static_cast<double>(i) + 0.5) * k_caption_row_px,
                      plot.caption[i], 12, {90, 94, 102}, false);
        };
        actor->GetScene()->AddItem(around);
        vtkNew<vtkTextActor> title;
        title->SetInput(fitting(text, plot.title, k_title_size, width - 2.0 * k_plot_side_px,
                                Cut::end, FontStyle::bold)
                            .c_str());
        title->SetPosition(0.5 * width, height - 0.5 * k_title_px);
        set_font(title->GetTextProperty(), k_title_size, SPHEROSCOPE_FONT_BOLD);
        title->GetTextProperty()->SetJustificationToCentered();
        title->GetTextProperty()->SetVerticalJustificationToCentered();
        renderer->AddActor(actor);
        renderer->AddActor2D(title);
        window->Render();  // charts lay out their axes while they are drawn
        // Colours mean the same in all panels: one legend, where there is room.
        if (!plot.legend_above) show_legend_inside(plot, areas, styles, text);
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
