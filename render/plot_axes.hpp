#pragma once

#include "engine/reports/plot.hpp"

#include <optional>
#include <string>
#include <vector>

class vtkAxis;
class vtkTextProperty;

namespace spheroscope::render {

/// The project's font files: VTK's built-in font has neither Greek nor superscripts. nullptr: the
/// normal one.
void set_font(vtkTextProperty* text, int size, const char* file = nullptr);

/// What one axis shows; in powers of ten where it is logarithmic.
struct AxisRange {
    /// Where the axis is interrupted: what is beyond `near` stands in a strip of its own.
    struct Break {
        double near;                    ///< the end of what is drawn to scale, value and place
        double far_begin, far_end;      ///< values of the strip; the same: one
        double place_begin, place_end;  ///< theirs
        double gap;                     ///< place of the interruption
    };
    double low = 1.0, high = -1.0;
    bool is_logarithmic;
    std::optional<Break> broken;

    explicit AxisRange(const reports::Plot::Axis& axis);
    /// Where a value stands on the axis.
    [[nodiscard]] double place(double value) const;
    void include(double value);
    /// Some space around the points, but none below zero where all are above it; of a logarithmic
    /// axis as much as two labels need.
    void widen();
    /// Adds a strip for [begin, end], which is on one side of the range. Precondition: widened,
    /// linear.
    void break_off(double begin, double end);
};

/// A label of an axis and its place on it.
struct AxisTick {
    double place;
    std::string label;
};
/// Powers of ten within a logarithmic range, and twice and five times them where there are fewer
/// than two. Never fewer than two labels for a range that was widened.
[[nodiscard]] std::vector<AxisTick> logarithmic_ticks(const AxisRange& range);

/// Range, title, grid and labels of one axis. Logarithms have been taken: the axis is linear with
/// labels of its own.
void set_axis(vtkAxis* axis, const std::string& title, const AxisRange& range,
              const std::vector<std::string>& categories);

}  // namespace spheroscope::render
