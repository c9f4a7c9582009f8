#pragma once

#include "engine/reports/plot.hpp"
#include "render/image.hpp"
#include "render/plot_area.hpp"

#include <vector>

class vtkContext2D;

namespace spheroscope::render {

/// What a panel has beside the lines of VTK's charts: ranges of values that something else was
/// found in (bands; a line if both ends are equal), error bars, and coloured fields.

inline constexpr int k_colour_bar_px = 135;  ///< room for the bar beside a map, with its title

void paint_bands(vtkContext2D& painter, const PlotArea& area,
                 const std::vector<reports::Plot::Band>& bands);
void paint_band_names(vtkContext2D& painter, const PlotArea& area,
                      const std::vector<reports::Plot::Band>& bands);
/// The sign that the axis of y is interrupted, if it is: a gap across the panel, and two strokes;
/// and the bands once more, on which the grid has drawn lines at their ends.
void paint_break(vtkContext2D& painter, const PlotArea& area,
                 const std::vector<reports::Plot::Band>& bands);
void paint_error_bars(vtkContext2D& painter, const PlotArea& area,
                      const reports::Plot::Series& series, Rgb colour);
void paint_map(vtkContext2D& painter, const PlotArea& area, const reports::Plot::Map& map);
void paint_colour_bar(vtkContext2D& painter, const PlotArea& area, const reports::Plot::Map& map);

}  // namespace spheroscope::render
