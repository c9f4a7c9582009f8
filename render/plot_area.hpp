#pragma once

#include "engine/reports/plot.hpp"
#include "render/image.hpp"
#include "render/plot_axes.hpp"

#include <cstddef>
#include <map>
#include <string>
#include <vector>

class vtkChartXY;
class vtkPlotLine;

namespace spheroscope::render {

/// Where the values of a panel are in the scene (px). A chart knows after it was drawn once.
struct PlotArea {
    vtkChartXY* chart;
    AxisRange x_range, y_range;

    /// Values beyond an axis are at its end.
    [[nodiscard]] double x(double value) const;
    [[nodiscard]] double y(double value) const;
    /// Where the axis of y is interrupted. Precondition: it is.
    [[nodiscard]] double break_y() const;
    [[nodiscard]] double left() const;
    [[nodiscard]] double right() const;
    [[nodiscard]] double top() const;
    [[nodiscard]] double bottom() const;
};

/// The axes that hold all of a panel, set on its chart.
PlotArea area_of(const reports::Plot::Panel& panel, vtkChartXY* chart);

/// The colour and mark of a name, the same in all panels.
class PlotStyles {
  public:
    explicit PlotStyles(const reports::Plot& plot);
    /// Of the series with a colour of their own, in the order of their first appearance.
    [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
    [[nodiscard]] Rgb colour(const std::string& name) const;
    [[nodiscard]] Rgb colour(const reports::Plot::Series& series) const;
    void apply(const reports::Plot::Series& series, vtkPlotLine* line) const;
    /// How the line and the marks of a name look, in VTK's numbers; NONE where it has no marks.
    /// Names beyond the number of colours have marks always: without them two would look alike.
    [[nodiscard]] int line_type(const std::string& name) const;
    [[nodiscard]] int marker(const std::string& name) const;

  private:
    struct Look {
        std::size_t number;  ///< of the name: its colour, and its mark
        reports::Plot::Line line;
        bool has_marks;
    };
    std::map<std::string, Look> looks_;  // by name, of its first series
    std::vector<std::string> names_;
};

}  // namespace spheroscope::render
