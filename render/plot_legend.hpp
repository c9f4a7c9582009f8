#pragma once

#include "engine/reports/plot.hpp"
#include "render/plot_area.hpp"
#include "render/text.hpp"

#include <string>
#include <vector>

class vtkContext2D;

namespace spheroscope::render {

inline constexpr int k_legend_row_px = 24;

/// The legend above the panels: the names of all series in as many columns as have room.
struct LegendRows {
    std::vector<std::string> texts;  ///< as in PlotStyles::names(), none longer than a row
    int n_columns = 1, n_rows = 0;

    LegendRows(const PlotStyles& styles, int width_px, TextPainter& text);
    /// From y_px downward.
    void paint(vtkContext2D& painter, const PlotStyles& styles, int width_px, double y_px) const;
};

/// Shows the legend inside the panel and at the corner or side where it hides least, preferably in
/// the upper right corner of the first, clear of the panel's edges and so of its title.
/// Precondition: the panels were drawn once.
void show_legend_inside(const reports::Plot& plot, const std::vector<PlotArea>& areas,
                        const PlotStyles& styles, TextPainter& text);

}  // namespace spheroscope::render
