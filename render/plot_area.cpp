#include "render/plot_area.hpp"

#include "render/colour_maps.hpp"

#include <vtkAxis.h>
#include <vtkChartXY.h>
#include <vtkPen.h>
#include <vtkPlotLine.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace spheroscope::render {
namespace {

constexpr std::array<int, 5> k_markers{vtkPlotPoints::CIRCLE, vtkPlotPoints::SQUARE,
                                       vtkPlotPoints::DIAMOND, vtkPlotPoints::CROSS,
                                       vtkPlotPoints::PLUS};

int vtk_line_type(reports::Plot::Line line) {
    switch (line) {
    case reports::Plot::Line::full: return vtkPen::SOLID_LINE;
    case reports::Plot::Line::dashed: return vtkPen::DASH_LINE;
    case reports::Plot::Line::none: break;
    }
    return vtkPen::NO_PEN;
}

double at_place(const AxisRange& range, double place, int low_px, int high_px) {
    const double share = (place - range.low) / (range.high - range.low);
    return low_px + std::clamp(share, 0.0, 1.0) * (high_px - low_px);
}

/// Ends of the axis for what is beyond them.
double along(const AxisRange& range, double value, int low_px, int high_px) {
    const bool is_below = range.is_logarithmic && value <= 0.0;
    return at_place(range, is_below ? range.low : range.place(value), low_px, high_px);
}

/// Widens the range of the points and adds the bands to it: to scale, or behind a break.
void include_bands(const reports::Plot::Panel& panel, AxisRange& range) {
    constexpr double k_smallest_share = 0.25;  // of the axis for points
    AxisRange whole = range, of_bands = range;
    of_bands.low = 1.0;
    of_bands.high = -1.0;
    for (const reports::Plot::Band& band : panel.bands)
        for (const double end : {band.low, band.high}) {
            whole.include(end);
            of_bands.include(end);
        }
    const auto is_beside = [&] { return of_bands.high < range.low || of_bands.low > range.high; };
    const bool is_broken = panel.y_axis.breaks_before_bands && !range.is_logarithmic &&
                           !panel.bands.empty() && range.low <= range.high && is_beside() &&
                           range.high - range.low < k_smallest_share * (whole.high - whole.low);
    if (is_broken)
        range.include(0.0);  // without it nobody sees how far the points are from none
    else
        range = whole;
    if (panel.y_axis.categories.empty() && !panel.map) range.widen();
    // not where the room around the points has reached them
    if (is_broken && is_beside()) range.break_off(of_bands.low, of_bands.high);
}

}  // namespace

double PlotArea::x(double value) const {
    return along(x_range, value, chart->GetPoint1()[0], chart->GetPoint2()[0]);
}
double PlotArea::y(double value) const {
    return along(y_range, value, chart->GetPoint1()[1], chart->GetPoint2()[1]);
}
double PlotArea::break_y() const {
    return at_place(y_range, y_range.broken.value().gap, chart->GetPoint1()[1],
                    chart->GetPoint2()[1]);
}
double PlotArea::left() const { return chart->GetPoint1()[0]; }
double PlotArea::right() const { return chart->GetPoint2()[0]; }
double PlotArea::top() const { return chart->GetPoint2()[1]; }
double PlotArea::bottom() const { return chart->GetPoint1()[1]; }

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
    if (x_axis.categories.empty()) area.x_range.widen();
    include_bands(panel, area.y_range);
    set_axis(chart->GetAxis(vtkAxis::BOTTOM), panel.x_title, area.x_range, x_axis.categories);
    set_axis(chart->GetAxis(vtkAxis::LEFT), panel.y_title, area.y_range, y_axis.categories);
    return area;
}

PlotStyles::PlotStyles(const reports::Plot& plot) {
    for (const reports::Plot::Panel& panel : plot.panels)
        for (const reports::Plot::Series& series : panel.series)
            if (series.colour_of.empty() &&
                looks_.emplace(series.name, Look{looks_.size(), series.line, series.has_marks})
                    .second)
                names_.push_back(series.name);
}

Rgb PlotStyles::colour(const std::string& name) const {
    return k_distinct_colours[looks_.at(name).number % k_distinct_colours.size()];
}

Rgb PlotStyles::colour(const reports::Plot::Series& series) const {
    return colour(series.colour_of.empty() ? series.name : series.colour_of);
}

int PlotStyles::line_type(const std::string& name) const {
    return vtk_line_type(looks_.at(name).line);
}

int PlotStyles::marker(const std::string& name) const {
    const Look& look = looks_.at(name);
    return look.has_marks || look.number >= k_distinct_colours.size()
               ? k_markers[look.number % k_markers.size()]
               : static_cast<int>(vtkPlotPoints::NONE);
}

void PlotStyles::apply(const reports::Plot::Series& series, vtkPlotLine* line) const {
    const Rgb c = colour(series);
    line->SetColor(c.r, c.g, c.b, 255);
    line->SetWidth(2.0F);
    line->GetPen()->SetLineType(vtk_line_type(series.line));
    int mark = series.colour_of.empty() ? marker(series.name) : int{vtkPlotPoints::NONE};
    if (series.is_crossed_out) mark = vtkPlotPoints::CROSS;
    line->SetMarkerStyle(mark);
    line->SetMarkerSize(series.is_crossed_out ? 15.0F : 9.0F);
    line->SetLabel(series.name);
    line->SetLegendVisibility(series.colour_of.empty());
}

}  // namespace spheroscope::render
