#pragma once

#include "engine/reports/plot.hpp"

#include <string>
#include <vector>

class vtkAxis;
class vtkTextProperty;

namespace spheroscope::render {

/// The project's font file: VTK's built-in font has neither Greek nor superscripts.
void set_font(vtkTextProperty* text, int size, const char* file = SPHEROSCOPE_FONT);

/// What one axis shows; in powers of ten where it is logarithmic.
struct AxisRange {
    double low = 1.0, high = -1.0;
    bool is_logarithmic;

    explicit AxisRange(const reports::Plot::Axis& axis);
    /// Where a value stands on the axis.
    [[nodiscard]] double place(double value) const;
    void include(double value);
    /// Some space around the points, but none below zero where all are above it; of a logarithmic
    /// axis at least one whole decade.
    void widen();
};

/// Range, title, grid and labels of one axis. Logarithms have been taken: the axis is linear with
/// labels of its own.
void set_axis(vtkAxis* axis, const std::string& title, const AxisRange& range,
              const std::vector<std::string>& categories);

}  // namespace spheroscope::render
