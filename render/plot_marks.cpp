#include "render/plot_marks.hpp"

#include "render/colour_maps.hpp"
#include "render/line_chart.hpp"
#include "render/plot_ink.hpp"

#include <vtkContext2D.h>

#include <algorithm>
#include <cmath>

namespace spheroscope::render {
namespace {

constexpr Rgb k_band{255, 236, 200}, k_band_ink{150, 95, 0};

Rgb colour_of(const reports::Plot::Map& map, double value) {
    const ColourMap& colours = map.is_signed ? ColourMap::diverging() : ColourMap::sequential();
    const double share = (value - map.low) / (map.high - map.low);
    if (share < -1e-9) return colours.below();
    if (share > 1.0 + 1e-9) return colours.above();
    return colours.at(std::clamp(share, 0.0, 1.0));
}

}  // namespace

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
        // at the band's upper edge: inside where it is wide enough, else above it or below it
        const double low = area.y(band.low), high = area.y(band.high);
        const bool is_wide = high - low > 24.0;
        const double outside = high + 18.0 < area.top() ? high + 10.0 : low - 10.0;
        write(painter, area.left() + 8.0, is_wide ? high - 10.0 : outside, band.name, 12,
              k_band_ink, false);
    }
}

void paint_break(vtkContext2D& painter, const PlotArea& area,
                 const std::vector<reports::Plot::Band>& bands) {
    if (!area.y_range.broken) return;
    paint_bands(painter, area, bands);
    constexpr double half_gap_px = 3.0;
    const double y = area.break_y();
    use_brush(painter, {255, 255, 255});
    fill(painter, area.left() - 2.0, y - half_gap_px, area.right() + 2.0, y + half_gap_px);
    use_pen(painter, k_plot_ink, 1.2F);
    const auto x = static_cast<float>(area.left());
    for (const double edge : {y - half_gap_px, y + half_gap_px}) {
        const auto middle = static_cast<float>(edge);
        painter.DrawLine(x - 6.0F, middle - 3.0F, x + 6.0F, middle + 3.0F);
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
        const Rgb ink = to_oklab(colour).lightness > 0.62 ? k_plot_ink : Rgb{255, 255, 255};
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
              tick_label(i * step, step), 13, k_plot_ink, false);
    write(painter, x0 - 4.0, y1 + 16.0, map.title, 13, k_plot_ink, false);
}

}  // namespace spheroscope::render
