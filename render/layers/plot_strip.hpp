#pragma once

#include "render/image.hpp"
#include "render/range.hpp"
#include "render/text.hpp"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace spheroscope::render {

/// A measure of the whole aggregate against time, one curve for each run.
struct PlotStrip {
    struct Curve {
        std::string name;                   ///< shown only beside another
        std::vector<double> time_s, value;  ///< one for each frame; NaN: nothing there
    };
    std::string heading;  ///< "sigma_h_core (Pa)"
    std::vector<Curve> curves;
    std::vector<double> stage_begin_s;  ///< light vertical lines
};

/// How pictures write the unit of a stored number, and shown value / stored value: all stresses of
/// pictures are in Pa.
struct ShownUnit {
    std::string text;  ///< "µm²"; "" for a plain number
    double per_stored = 1.0;
};
[[nodiscard]] ShownUnit shown_unit(std::string_view stored_unit);

/// Draws the strip below a movie's pictures. Axes and curves are drawn once; a mark then moves.
class PlotStripPainter {
  public:
    PlotStripPainter(const PlotStrip& strip, int width_px, int picture_height_px);

    /// The strip with a mark on each curve at that time; one time for each curve.
    [[nodiscard]] Image draw(std::span<const double> time_s) const;
    /// Where a value stands in the strip, px.
    struct Point {
        double x, y;
    };
    [[nodiscard]] Point point(double time_s, double value) const;
    [[nodiscard]] Rgb colour(int curve) const;
    /// Height that the strip has below a picture of that height: a quarter, as far as axes and
    /// writing have room in it, and even.
    [[nodiscard]] static int height_px(int picture_height_px);

  private:
    void draw_axes(TextPainter& text, const Range& values);
    void draw_heading(TextPainter& text);

    PlotStrip strip_;
    Image background_;
    double scale_;
    bool has_values_ = false;  ///< one at least is a number: else there is no axis of values
    double left_ = 0, right_ = 0, top_ = 0, bottom_ = 0;  // of the axes, px
    double time_low_ = 0, time_high_ = 1, value_low_ = 0, value_high_ = 1;
};

}  // namespace spheroscope::render
