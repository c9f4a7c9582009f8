#include "render/plot_legend.hpp"

#include "render/plot_axes.hpp"
#include "render/plot_ink.hpp"

#include <vtkChartLegend.h>
#include <vtkChartXY.h>
#include <vtkContext2D.h>
#include <vtkPen.h>
#include <vtkPlotPoints.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace spheroscope::render {
namespace {

constexpr int k_legend_size = 14;
constexpr double k_swatch_px = 30.0, k_between_names_px = 26.0;

/// From a legend inside a panel to the panel's edges: letters of its title reach below the upper
/// one.
constexpr double k_inside_px = 8.0;

/// Where the legend stands inside a panel: its lower left corner in the scene, px.
struct LegendPlace {
    vtkChartXY* chart = nullptr;
    double x = 0.0, y = 0.0;
};

/// The begin of `size` at one end of a side of a panel, at the other, or in the middle.
double legend_begin(int alignment, double low, double high, double size) {
    if (alignment == vtkChartLegend::CENTER) return 0.5 * (low + high - size);
    const bool is_high = alignment == vtkChartLegend::RIGHT || alignment == vtkChartLegend::TOP;
    return is_high ? high - k_inside_px - size : low + k_inside_px;
}

/// The line and the mark of a name, as the panels have them.
void paint_swatch(vtkContext2D& painter, const PlotStyles& styles, const std::string& name,
                  double x, double middle) {
    const Rgb colour = styles.colour(name);
    const auto x0 = static_cast<float>(x), y = static_cast<float>(middle);
    use_pen(painter, colour, 2.5F);
    painter.GetPen()->SetLineType(styles.line_type(name));
    painter.DrawLine(x0, y, x0 + 24.0F, y);
    const int marker = styles.marker(name);
    if (marker == vtkPlotPoints::NONE) return;
    use_brush(painter, colour);
    use_pen(painter, colour, 10.0F);  // its width is the size of marks
    std::array<float, 2> place{x0 + 12.0F, y};
    painter.DrawMarkers(marker, false, place.data(), 1);
}

/// How much a legend of that size hides in a panel: points count, and lines between them a little.
double hidden_by(const LegendPlace& place, const reports::Plot::Panel& panel, const PlotArea& area,
                 double width, double height) {
    constexpr double marker_px = 6.0;
    constexpr int n_samples = 16;  // of a line between two points
    const auto hides = [&](double x, double y) {
        return x > place.x - marker_px && x < place.x + width + marker_px &&
               y > place.y - marker_px && y < place.y + height + marker_px;
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
                       const PlotStyles& styles, TextPainter& text) {
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
                const LegendPlace place{
                    areas[p].chart,
                    legend_begin(horizontal, areas[p].left(), areas[p].right(), width),
                    legend_begin(vertical, areas[p].bottom(), areas[p].top(), height)};
                const double hidden =
                    missing + hidden_by(place, plot.panels[p], areas[p], width, height);
                if (hidden >= least) continue;
                least = hidden;
                best = place;
            }
    }
    return best;
}

}  // namespace

LegendRows::LegendRows(const PlotStyles& styles, int width_px, TextPainter& text) {
    const double row_px = width_px - 2.0 * k_plot_side_px;
    double widest_px = 0.0;
    for (const std::string& name : styles.names()) {
        texts.push_back(fitting(text, name, k_legend_size, row_px - k_swatch_px, Cut::middle));
        widest_px = std::max(widest_px, k_swatch_px + text.width(texts.back(), {k_legend_size}));
    }
    n_columns = std::max(
        1, static_cast<int>((row_px + k_between_names_px) / (widest_px + k_between_names_px)));
    n_rows = (static_cast<int>(texts.size()) + n_columns - 1) / n_columns;
}

void LegendRows::paint(vtkContext2D& painter, const PlotStyles& styles, int width_px,
                       double y_px) const {
    const double column_px = (width_px - 2.0 * k_plot_side_px) / n_columns;
    for (std::size_t i = 0; i < texts.size(); ++i) {
        const auto column = static_cast<int>(i) % n_columns, row = static_cast<int>(i) / n_columns;
        const double x = k_plot_side_px + column * column_px;
        const double middle = y_px - (row + 0.5) * k_legend_row_px;
        paint_swatch(painter, styles, styles.names()[i], x, middle);
        write(painter, x + k_swatch_px, middle, texts[i], k_legend_size, k_plot_ink, false);
    }
}

void show_legend_inside(const reports::Plot& plot, const std::vector<PlotArea>& areas,
                        const PlotStyles& styles, TextPainter& text) {
    const LegendPlace place = free_place(plot, areas, styles, text);
    place.chart->SetShowLegend(true);
    vtkChartLegend* const legend = place.chart->GetLegend();
    set_font(legend->GetLabelProperties(), k_legend_size);
    legend->SetHorizontalAlignment(vtkChartLegend::CUSTOM);
    legend->SetVerticalAlignment(vtkChartLegend::CUSTOM);
    legend->SetPoint({static_cast<float>(place.x), static_cast<float>(place.y)});
}

}  // namespace spheroscope::render
